// X3D 4.0 (ISO/IEC 19775-1:2023): abstract types, statements, and the nodes of its older components. Notation: x3d_table.hpp.
#include "server/scenario/x3d_table.hpp"

namespace mechane::scenario {

// clang-format off
const std::string_view kX3dCore = R"X3D(
X3DAppearanceChildNode:X3DNode
X3DAppearanceNode:X3DNode
X3DBackgroundNode:X3DBindableNode groundAngle:MFFloat groundColor:MFColor skyAngle:MFFloat skyColor:MFColor=0,0,0
  transparency:SFFloat[0,1]=0
X3DBindableNode:X3DChildNode
X3DBoundedObject: bboxCenter:SFVec3f=0,0,0 bboxSize:SFVec3f=-1,-1,-1 bboxDisplay:SFBool=false visible:SFBool=true
X3DChildNode:X3DNode
X3DColorNode:X3DGeometricPropertyNode
X3DComposedGeometryNode:X3DGeometryNode ccw:SFBool=true colorPerVertex:SFBool=true normalPerVertex:SFBool=true
  solid:SFBool=true +attrib*:X3DVertexAttributeNode +color:X3DColorNode +coord:X3DCoordinateNode
  +fogCoord:FogCoordinate +normal:X3DNormalNode +texCoord:X3DSingleTextureCoordinateNode|MultiTextureCoordinate
X3DCoordinateNode:X3DGeometricPropertyNode
X3DDragSensorNode:X3DPointingDeviceSensorNode autoOffset:SFBool=true
X3DEnvironmentalSensorNode:X3DSensorNode size:SFVec3f=0,0,0
X3DEnvironmentTextureNode:X3DTextureNode
X3DFogObject: color:SFColor=1,1,1 fogType:SFString=LINEAR visibilityRange:SFFloat[0,]=0
X3DFontStyleNode:X3DNode
X3DGeometricPropertyNode:X3DNode
X3DGeometryNode:X3DNode
X3DGroupingNode:X3DChildNode,X3DBoundedObject +children*:X3DChildNode
X3DInfoNode:X3DChildNode
X3DInterpolatorNode:X3DChildNode key:MFFloat
X3DKeyDeviceSensorNode:X3DSensorNode
X3DLightNode:X3DChildNode ambientIntensity:SFFloat[0,1]=0 color:SFColor=1,1,1 intensity:SFFloat[0,]=1 on:SFBool=true
  shadows:SFBool=false shadowIntensity:SFFloat[0,1]=1
X3DMaterialNode:X3DAppearanceChildNode
X3DMetadataObject: name:SFString reference:SFString
X3DNetworkSensorNode:X3DSensorNode
X3DNode:
X3DNodeMixedContent:X3DUrlObject
X3DNormalNode:X3DGeometricPropertyNode
X3DNurbsControlCurveNode:X3DNode controlPoint:MFVec2d
X3DNurbsSurfaceGeometryNode:X3DParametricGeometryNode solid:SFBool=true uClosed:SFBool=false vClosed:SFBool=false
  uDimension:SFInt32[0,]=0 vDimension:SFInt32[0,]=0 uKnot:MFDouble vKnot:MFDouble uOrder:SFInt32[2,]=3
  vOrder:SFInt32[2,]=3 uTessellation:SFInt32=0 vTessellation:SFInt32=0 weight:MFDouble
  +controlPoint:Coordinate|CoordinateDouble +texCoord:X3DSingleTextureCoordinateNode|NurbsTextureCoordinate
X3DParametricGeometryNode:X3DGeometryNode
X3DPointingDeviceSensorNode:X3DSensorNode
X3DProductStructureChildNode:X3DChildNode name:SFString
X3DProgrammableShaderObject:
X3DPrototypeInstance:X3DNode
X3DScriptNode:X3DChildNode,X3DUrlObject
X3DSensorNode:X3DChildNode description:SFString enabled:SFBool=true
X3DSequencerNode:X3DChildNode key:MFFloat
X3DShaderNode:X3DAppearanceChildNode language:SFString
X3DShapeNode:X3DChildNode,X3DBoundedObject castShadow:SFBool=true +appearance:X3DAppearanceNode
  +geometry:X3DGeometryNode
X3DSoundChannelNode:X3DSoundNode channelCountMode:SFString=MAX channelInterpretation:SFString=SPEAKERS
  gain:SFFloat=1
X3DSoundDestinationNode:X3DSoundNode channelCountMode:SFString=MAX channelInterpretation:SFString=SPEAKERS
  gain:SFFloat=1 mediaDeviceID:SFString
X3DSoundNode:X3DChildNode description:SFString enabled:SFBool=true
X3DSoundProcessingNode:X3DTimeDependentNode,X3DSoundNode channelCountMode:SFString=MAX
  channelInterpretation:SFString=SPEAKERS enabled:SFBool=true gain:SFFloat=1 tailTime:SFTime[0,]=0
X3DSoundSourceNode:X3DTimeDependentNode,X3DSoundNode enabled:SFBool=true gain:SFFloat=1
X3DTextureNode:X3DAppearanceChildNode description:SFString
X3DTexture2DNode:X3DSingleTextureNode repeatS:SFBool=true repeatT:SFBool=true +textureProperties:TextureProperties
X3DTexture3DNode:X3DTextureNode repeatS:SFBool=false repeatT:SFBool=false repeatR:SFBool=false
  +textureProperties:TextureProperties
X3DTextureCoordinateNode:X3DGeometricPropertyNode
X3DTextureTransformNode:X3DAppearanceChildNode
X3DSingleTextureNode:X3DTextureNode
X3DSingleTextureCoordinateNode:X3DTextureCoordinateNode mapping:SFString
X3DSingleTextureTransformNode:X3DTextureTransformNode mapping:SFString
X3DTimeDependentNode:X3DChildNode description:SFString pauseTime:SFTime=0 resumeTime:SFTime=0 startTime:SFTime=0
  stopTime:SFTime=0
X3DTouchSensorNode:X3DPointingDeviceSensorNode
X3DTriggerNode:X3DChildNode
X3DUrlObject: description:SFString load:SFBool=true autoRefresh:SFTime[0,]=0 autoRefreshTimeLimit:SFTime[0,]=3600
  url:MFString
X3DVertexAttributeNode:X3DGeometricPropertyNode name:SFString
X3DStatement:
X3DViewpointNode:X3DBindableNode description:SFString jump:SFBool=true orientation:SFRotation=0,0,1,0
  retainUserOffsets:SFBool=false farDistance:SFFloat=-1 nearDistance:SFFloat=-1 viewAll:SFBool=false
X3DLayerNode:X3DNode,X3DPickableObject visible:SFBool=true +viewport:X3DViewportNode
X3DViewportNode:X3DGroupingNode
X3DLayoutNode:X3DChildNode
X3DNBodyCollidableNode:X3DChildNode,X3DBoundedObject enabled:SFBool=true rotation:SFRotation=0,0,1,0
  translation:SFVec3f=0,0,0
X3DNBodyCollisionSpaceNode:X3DNode,X3DBoundedObject enabled:SFBool=true
X3DRigidJointNode:X3DNode forceOutput:MFString +body1:RigidBody +body2:RigidBody
X3DPickableObject: objectType:MFString pickable:SFBool=true
X3DPickSensorNode:X3DSensorNode intersectionType:SFString=BOUNDS matchCriterion:SFString=MATCH_ANY
  objectType:MFString sortOrder:SFString=CLOSEST +pickingGeometry:X3DGeometryNode
  +pickTarget*:X3DGroupingNode|X3DShapeNode|Inline
X3DChaserNode:X3DFollowerNode duration:SFTime[0,]=1
X3DDamperNode:X3DFollowerNode tau:SFTime[0,]=0.3 tolerance:SFFloat=-1 order:SFInt32[0,5]=3
X3DFollowerNode:X3DChildNode
X3DParticleEmitterNode:X3DNode on:SFBool=true speed:SFFloat[0,]=0 variation:SFFloat[0,]=0.25 mass:SFFloat[0,]=0
  surfaceArea:SFFloat[0,]=0
X3DParticlePhysicsModelNode:X3DNode enabled:SFBool=true
X3DComposableVolumeRenderStyleNode:X3DVolumeRenderStyleNode
X3DVolumeDataNode:X3DChildNode,X3DBoundedObject dimensions:SFVec3f=1,1,1
X3DVolumeRenderStyleNode:X3DNode enabled:SFBool=true
X3DTextureProjectorNode:X3DLightNode description:SFString direction:SFVec3f=0,0,1 farDistance:SFFloat[-1,]=-1
  global:SFBool=true location:SFVec3f=0,0,0 nearDistance:SFFloat[-1,]=-1 upVector:SFVec3f=0,1,0
  +texture:X3DTexture2DNode
X3DOneSidedMaterialNode:X3DMaterialNode emissiveTextureMapping:SFString normalScale:SFFloat[0,]=1
  normalTextureMapping:SFString
Anchor@children:X3DGroupingNode,X3DUrlObject parameter:MFString
Appearance@appearance:X3DAppearanceNode alphaCutoff:SFFloat[0,1]=0.5 alphaMode:SFString=AUTO
  +acousticProperties:AcousticProperties +backMaterial:X3DMaterialNode +fillProperties:FillProperties
  +lineProperties:LineProperties +pointProperties:PointProperties +material:X3DMaterialNode +shaders*:X3DShaderNode
  +texture:X3DTextureNode +textureTransform:X3DTextureTransformNode
Arc2D@geometry:X3DGeometryNode radius:SFFloat(0,]=1 startAngle:SFFloat(-6.2832,6.2832)=0
  endAngle:SFFloat(-6.2832,6.2832)=1.570796
ArcClose2D@geometry:X3DGeometryNode radius:SFFloat(0,]=1 startAngle:SFFloat(-6.2832,6.2832)=0
  endAngle:SFFloat(-6.2832,6.2832)=1.570796 closureType:SFString=PIE solid:SFBool=false
AudioClip@source:X3DSoundSourceNode,X3DUrlObject loop:SFBool=false pitch:SFFloat(0,]=1.0
Background@children:X3DBackgroundNode backUrl:MFString bottomUrl:MFString frontUrl:MFString leftUrl:MFString
  rightUrl:MFString topUrl:MFString
Billboard@children:X3DGroupingNode axisOfRotation:SFVec3f=0,1,0
BooleanFilter@children:X3DChildNode
BooleanSequencer@children:X3DSequencerNode keyValue:MFBool
BooleanToggle@children:X3DChildNode toggle:SFBool=false
BooleanTrigger@children:X3DTriggerNode
Box@geometry:X3DGeometryNode size:SFVec3f=2,2,2 solid:SFBool=true
Circle2D@geometry:X3DGeometryNode radius:SFFloat(0,]=1
ClipPlane@children:X3DChildNode enabled:SFBool=true plane:SFVec4f=0,1,0,0
Collision@children:X3DGroupingNode,X3DSensorNode description:SFString enabled:SFBool=true +proxy:X3DChildNode
Color@color:X3DColorNode color:MFColor
ColorRGBA@color:X3DColorNode color:MFColorRGBA
ColorInterpolator@children:X3DInterpolatorNode keyValue:MFColor
Cone@geometry:X3DGeometryNode bottom:SFBool=true bottomRadius:SFFloat(0,]=1 height:SFFloat(0,]=2 side:SFBool=true
  solid:SFBool=true
Coordinate@coord:X3DCoordinateNode point:MFVec3f
CoordinateDouble@coord:X3DCoordinateNode point:MFVec3d
CoordinateInterpolator@children:X3DInterpolatorNode keyValue:MFVec3f
CoordinateInterpolator2D@children:X3DInterpolatorNode keyValue:MFVec2f
Cylinder@geometry:X3DGeometryNode bottom:SFBool=true height:SFFloat(0,]=2 radius:SFFloat(0,]=1 side:SFBool=true
  solid:SFBool=true top:SFBool=true
CylinderSensor@children:X3DDragSensorNode axisRotation:SFRotation=0,0,1,0 diskAngle:SFFloat[0,1.5708]=0.26179167
  maxAngle:SFFloat(-6.2832,6.2832)=-1 minAngle:SFFloat(-6.2832,6.2832)=0 offset:SFFloat=0
DirectionalLight@children:X3DLightNode direction:SFVec3f=0,0,-1 global:SFBool=false
Disk2D@geometry:X3DGeometryNode innerRadius:SFFloat[0,]=0 outerRadius:SFFloat(0,]=1 solid:SFBool=false
ElevationGrid@geometry:X3DGeometryNode height:MFFloat ccw:SFBool=true colorPerVertex:SFBool=true
  creaseAngle:SFFloat[0,]=0 normalPerVertex:SFBool=true solid:SFBool=true xDimension:SFInt32[0,]=0
  xSpacing:SFFloat(0,]=1.0 zDimension:SFInt32[0,]=0 zSpacing:SFFloat(0,]=1.0 +attrib*:X3DVertexAttributeNode
  +color:X3DColorNode +fogCoord:FogCoordinate +normal:X3DNormalNode +texCoord:X3DSingleTextureCoordinateNode
Extrusion@geometry:X3DGeometryNode beginCap:SFBool=true ccw:SFBool=true convex:SFBool=true creaseAngle:SFFloat[0,]=0
  crossSection:MFVec2f=1,1,1,-1,-1,-1,-1,1,1,1 endCap:SFBool=true orientation:MFRotation=0,0,1,0 scale:MFVec2f=1,1
  solid:SFBool=true spine:MFVec3f=0,0,0,0,1,0
FillProperties@fillProperties:X3DAppearanceChildNode filled:SFBool=true hatched:SFBool=true hatchStyle:SFInt32[0,]=1
  hatchColor:SFColor=1,1,1
Fog@children:X3DBindableNode,X3DFogObject
FogCoordinate@fogCoord:X3DGeometricPropertyNode depth:MFFloat
FontStyle@fontStyle:X3DFontStyleNode family:MFString horizontal:SFBool=true justify:MFString language:SFString
  leftToRight:SFBool=true size:SFFloat(0,]=1.0 spacing:SFFloat[0,]=1.0 topToBottom:SFBool=true
Group@children:X3DGroupingNode
ImageTexture@texture:X3DTexture2DNode,X3DUrlObject
IndexedFaceSet@geometry:X3DComposedGeometryNode convex:SFBool=true creaseAngle:SFFloat[0,]=0 colorIndex:MFInt32
  coordIndex:MFInt32 normalIndex:MFInt32 texCoordIndex:MFInt32
IndexedLineSet@geometry:X3DGeometryNode colorPerVertex:SFBool=true colorIndex:MFInt32 coordIndex:MFInt32
  +attrib*:X3DVertexAttributeNode +color:X3DColorNode +coord:X3DCoordinateNode +fogCoord:FogCoordinate
  +normal:X3DNormalNode
IndexedTriangleFanSet@geometry:X3DComposedGeometryNode index:MFInt32
IndexedTriangleSet@geometry:X3DComposedGeometryNode index:MFInt32
IndexedTriangleStripSet@geometry:X3DComposedGeometryNode index:MFInt32
Inline@children:X3DChildNode,X3DBoundedObject,X3DUrlObject global:SFBool=false
IntegerSequencer@children:X3DSequencerNode keyValue:MFInt32
IntegerTrigger@children:X3DTriggerNode integerKey:SFInt32=-1
KeySensor@children:X3DKeyDeviceSensorNode
LineProperties@lineProperties:X3DAppearanceChildNode applied:SFBool=true linetype:SFInt32[0,]=1 alias:SFString
  linewidthScaleFactor:SFFloat=0
PointProperties@pointProperties:X3DAppearanceChildNode pointSizeScaleFactor:SFFloat[1,]=1
  pointSizeMinValue:SFFloat[0,]=1 pointSizeMaxValue:SFFloat[0,]=1 attenuation:SFVec3f=1,0,0
TextureProperties@textureProperties:X3DNode anisotropicDegree:SFFloat[1,]=1 borderColor:SFColorRGBA=0,0,0,0
  borderWidth:SFInt32[0,]=0 boundaryModeS:SFString=REPEAT boundaryModeT:SFString=REPEAT
  boundaryModeR:SFString=REPEAT magnificationFilter:SFString=FASTEST minificationFilter:SFString=FASTEST
  textureCompression:SFString=FASTEST texturePriority:SFFloat[0,1]=0 generateMipMaps:SFBool=false
LineSet@geometry:X3DGeometryNode vertexCount:MFInt32 +attrib*:X3DVertexAttributeNode +color:X3DColorNode
  +coord:X3DCoordinateNode +fogCoord:FogCoordinate +normal:X3DNormalNode
LoadSensor@children:X3DNetworkSensorNode timeOut:SFTime[0,]=0 +children*:X3DUrlObject
LocalFog@children:X3DChildNode,X3DFogObject enabled:SFBool=true
LOD@children:X3DGroupingNode forceTransitions:SFBool=false center:SFVec3f=0,0,0 range:MFFloat
Material@material:X3DOneSidedMaterialNode ambientIntensity:SFFloat[0,1]=0.2 ambientTextureMapping:SFString
  diffuseColor:SFColor=0.8,0.8,0.8 diffuseTextureMapping:SFString emissiveColor:SFColor=0,0,0
  occlusionStrength:SFFloat[0,1]=1 occlusionTextureMapping:SFString shininess:SFFloat[0,1]=0.2
  shininessTextureMapping:SFString specularColor:SFColor=0,0,0 specularTextureMapping:SFString
  transparency:SFFloat[0,1]=0 +ambientTexture:X3DSingleTextureNode +diffuseTexture:X3DSingleTextureNode
  +emissiveTexture:X3DSingleTextureNode +normalTexture:X3DSingleTextureNode +occlusionTexture:X3DSingleTextureNode
  +shininessTexture:X3DSingleTextureNode +specularTexture:X3DSingleTextureNode
TwoSidedMaterial@material:X3DMaterialNode ambientIntensity:SFFloat[0,1]=0.2 backAmbientIntensity:SFFloat[0,1]=0.2
  diffuseColor:SFColor=0.8,0.8,0.8 backDiffuseColor:SFColor=0.8,0.8,0.8 emissiveColor:SFColor=0,0,0
  backEmissiveColor:SFColor=0,0,0 shininess:SFFloat[0,1]=0.2 backShininess:SFFloat[0,1]=0.2
  specularColor:SFColor=0,0,0 backSpecularColor:SFColor=0,0,0 transparency:SFFloat[0,1]=0
  backTransparency:SFFloat[0,1]=0 separateBackColor:SFBool=false
MetadataBoolean@value:X3DNode,X3DMetadataObject value:MFBool
MetadataDouble@value:X3DNode,X3DMetadataObject value:MFDouble
MetadataFloat@value:X3DNode,X3DMetadataObject value:MFFloat
MetadataInteger@value:X3DNode,X3DMetadataObject value:MFInt32
MetadataSet@value:X3DNode,X3DMetadataObject +value*:X3DMetadataObject
MetadataString@value:X3DNode,X3DMetadataObject value:MFString
MovieTexture@texture:X3DSoundSourceNode,X3DTexture2DNode,X3DUrlObject loop:SFBool=false pitch:SFFloat(0,]=1.0
  repeatS:SFBool=true repeatT:SFBool=true speed:SFFloat=1.0 +textureProperties:TextureProperties
MultiTexture@texture:X3DTextureNode alpha:SFFloat[0,1]=1 color:SFColor=1,1,1 function:MFString mode:MFString
  source:MFString +texture*:X3DSingleTextureNode
MultiTextureCoordinate@texCoord:X3DTextureCoordinateNode +texCoord*:X3DSingleTextureCoordinateNode
MultiTextureTransform@textureTransform:X3DTextureTransformNode +textureTransform*:X3DSingleTextureTransformNode
NavigationInfo@children:X3DBindableNode avatarSize:MFFloat=0.25,1.6,0.75 headlight:SFBool=true speed:SFFloat[0,]=1
  transitionTime:SFTime[0,]=1.0 transitionType:MFString type:MFString visibilityLimit:SFFloat[0,]=0
Normal@normal:X3DNormalNode vector:MFVec3f
NormalInterpolator@children:X3DInterpolatorNode keyValue:MFVec3f
OrientationInterpolator@children:X3DInterpolatorNode keyValue:MFRotation
PixelTexture@texture:X3DTexture2DNode image:SFImage=0,0,0
PlaneSensor@children:X3DDragSensorNode axisRotation:SFRotation=0,0,1,0 maxPosition:SFVec2f=-1,-1
  minPosition:SFVec2f=0,0 offset:SFVec3f=0,0,0
PointLight@children:X3DLightNode attenuation:SFVec3f=1,0,0 location:SFVec3f=0,0,0 radius:SFFloat[0,]=100
  global:SFBool=true
PointSet@geometry:X3DGeometryNode +attrib*:X3DVertexAttributeNode +color:X3DColorNode +coord:X3DCoordinateNode
  +fogCoord:FogCoordinate +normal:X3DNormalNode
Polyline2D@geometry:X3DGeometryNode lineSegments:MFVec2f
Polypoint2D@geometry:X3DGeometryNode point:MFVec2f
PositionInterpolator@children:X3DInterpolatorNode keyValue:MFVec3f
PositionInterpolator2D@children:X3DInterpolatorNode keyValue:MFVec2f
ProximitySensor@children:X3DEnvironmentalSensorNode center:SFVec3f=0,0,0
Rectangle2D@geometry:X3DGeometryNode size:SFVec2f=2,2 solid:SFBool=false
ScalarInterpolator@children:X3DInterpolatorNode keyValue:MFFloat
EaseInEaseOut@children:X3DChildNode easeInEaseOut:MFVec2f key:MFFloat
SplinePositionInterpolator@children:X3DInterpolatorNode closed:SFBool=false keyValue:MFVec3f keyVelocity:MFVec3f
  normalizeVelocity:SFBool=false
SplinePositionInterpolator2D@children:X3DInterpolatorNode closed:SFBool=false keyValue:MFVec2f keyVelocity:MFVec2f
  normalizeVelocity:SFBool=false
SplineScalarInterpolator@children:X3DInterpolatorNode closed:SFBool=false keyValue:MFFloat keyVelocity:MFFloat
  normalizeVelocity:SFBool=false
SquadOrientationInterpolator@children:X3DInterpolatorNode keyValue:MFRotation normalizeVelocity:SFBool=false
Script@children:X3DScriptNode directOutput:SFBool=false mustEvaluate:SFBool=false +field*:field
Shape@children:X3DShapeNode
Sound@children:X3DSoundNode direction:SFVec3f=0,0,1 intensity:SFFloat[0,1]=1 location:SFVec3f=0,0,0
  maxBack:SFFloat[0,]=10 maxFront:SFFloat[0,]=10 minBack:SFFloat[0,]=1 minFront:SFFloat[0,]=1
  priority:SFFloat[0,1]=0 spatialize:SFBool=true +source:X3DSoundSourceNode
SpatialSound@children:X3DSoundNode coneInnerAngle:SFFloat[0,6.2832]=6.2832 coneOuterAngle:SFFloat[0,6.2832]=6.2832
  coneOuterGain:SFFloat=0 direction:SFVec3f=0,0,1 distanceModel:SFString=INVERSE dopplerEnabled:SFBool=false
  enableHRTF:SFBool=false gain:SFFloat=1 intensity:SFFloat[0,1]=1 location:SFVec3f=0,0,0
  maxDistance:SFFloat[0,]=10000 priority:SFFloat[0,1]=0 referenceDistance:SFFloat[0,]=1 rolloffFactor:SFFloat[0,]=1
  spatialize:SFBool=true +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
Sphere@geometry:X3DGeometryNode radius:SFFloat(0,]=1 solid:SFBool=true
SphereSensor@children:X3DDragSensorNode offset:SFRotation=0,1,0,0
SpotLight@children:X3DLightNode attenuation:SFVec3f=1,0,0 beamWidth:SFFloat(0,1.570796]=0.589049
  cutOffAngle:SFFloat(0,1.570796]=1.570796 direction:SFVec3f=0,0,-1 location:SFVec3f=0,0,0 radius:SFFloat[0,]=100
  global:SFBool=true
StaticGroup@children:X3DChildNode,X3DBoundedObject +children*:X3DChildNode
StringSensor@children:X3DKeyDeviceSensorNode deletionAllowed:SFBool=true
Switch@children:X3DGroupingNode whichChoice:SFInt32[-1,]=-1
Text@geometry:X3DGeometryNode string:MFString length:MFFloat maxExtent:SFFloat[0,]=0.0 solid:SFBool=false
  +fontStyle:X3DFontStyleNode
TextureBackground@children:X3DBackgroundNode +backTexture:X3DTexture2DNode|MultiTexture
  +bottomTexture:X3DTexture2DNode|MultiTexture +frontTexture:X3DTexture2DNode|MultiTexture
  +leftTexture:X3DTexture2DNode|MultiTexture +rightTexture:X3DTexture2DNode|MultiTexture
  +topTexture:X3DTexture2DNode|MultiTexture
TextureCoordinate@texCoord:X3DSingleTextureCoordinateNode point:MFVec2f
TextureCoordinateGenerator@texCoord:X3DSingleTextureCoordinateNode mode:SFString=SPHERE parameter:MFFloat
TextureTransform@textureTransform:X3DSingleTextureTransformNode center:SFVec2f=0,0 rotation:SFFloat=0
  scale:SFVec2f=1,1 translation:SFVec2f=0,0
TimeSensor@children:X3DTimeDependentNode,X3DSensorNode cycleInterval:SFTime[0,]=1.0 enabled:SFBool=true
  loop:SFBool=false
TimeTrigger@children:X3DTriggerNode
TouchSensor@children:X3DTouchSensorNode
Transform@children:X3DGroupingNode center:SFVec3f=0,0,0 rotation:SFRotation=0,0,1,0 scale:SFVec3f=1,1,1
  scaleOrientation:SFRotation=0,0,1,0 translation:SFVec3f=0,0,0
TransformSensor@children:X3DEnvironmentalSensorNode center:SFVec3f=0,0,0 +targetObject:X3DGroupingNode|X3DShapeNode
TriangleFanSet@geometry:X3DComposedGeometryNode fanCount:MFInt32
TriangleSet@geometry:X3DComposedGeometryNode
TriangleSet2D@geometry:X3DGeometryNode vertices:MFVec2f solid:SFBool=false
TriangleStripSet@geometry:X3DComposedGeometryNode stripCount:MFInt32
Viewpoint@children:X3DViewpointNode centerOfRotation:SFVec3f=0,0,0 fieldOfView:SFFloat(0,3.1416)=0.7854
  position:SFVec3f=0,0,10
VisibilitySensor@children:X3DEnvironmentalSensorNode center:SFVec3f=0,0,0
WorldInfo@children:X3DInfoNode info:MFString title:SFString
component:X3DStatement name:SFString level:SFInt32[1,5]
unit:X3DStatement category:SFString name:SFString conversionFactor:SFDouble(0,]
EXPORT:X3DStatement localDEF:SFString AS:SFString
IMPORT:X3DStatement inlineDEF:SFString importedDEF:SFString AS:SFString
IS:X3DStatement +connect*:connect
connect:X3DStatement nodeField:SFString protoField:SFString
field:X3DStatement name:SFString accessType:SFString type:SFString value:SFString appinfo:SFString
  documentation:SFString +children*:X3DNode
fieldValue:X3DStatement name:SFString value:SFString +children*:X3DNode
head:X3DStatement +component*:component +unit*:unit +meta*:meta
meta:X3DStatement name:SFString content:SFString dir:SFString http-equiv:SFString lang:SFString scheme:SFString
ExternProtoDeclare:X3DStatement,X3DChildNode name:SFString url:MFString appinfo:SFString documentation:SFString
  +field*:field
ProtoDeclare:X3DStatement,X3DChildNode name:SFString appinfo:SFString documentation:SFString
  +ProtoInterface:ProtoInterface +ProtoBody:ProtoBody
ProtoInterface:X3DStatement +field*:field
ProtoBody:X3DStatement +children*:X3DNode
ProtoInstance@children:X3DPrototypeInstance,X3DChildNode name:SFString +fieldValue*:fieldValue
ROUTE:X3DStatement,X3DChildNode fromNode:SFString fromField:SFString toNode:SFString toField:SFString
Scene:X3DStatement +children*:X3DChildNode|X3DMetadataObject|LayerSet
X3D:X3DStatement version:SFString profile:SFString +head:head +Scene:Scene
)X3D";
// clang-format on

}  // namespace mechane::scenario
