// X3D 4.0 (ISO/IEC 19775-1:2023): the nodes of its further components. Notation: x3d_table.hpp.
#include "server/scenario/x3d_table.hpp"

namespace mechane::scenario {

// clang-format off
const std::string_view kX3dMore = R"X3D(
DISEntityManager@children:X3DChildNode address:SFString=localhost applicationID:SFInt32=0 port:SFInt32=0
  siteID:SFInt32=0 +children*:DISEntityTypeMapping
DISEntityTypeMapping@children:X3DInfoNode,X3DUrlObject category:SFInt32[0,255]=0 country:SFInt32[0,65535]=0
  domain:SFInt32[0,255]=0 extra:SFInt32[0,255]=0 kind:SFInt32[0,255]=0 specific:SFInt32[0,255]=0
  subcategory:SFInt32[0,255]=0
EspduTransform@children:X3DGroupingNode,X3DNetworkSensorNode description:SFString enabled:SFBool=true
  marking:SFString siteID:SFInt32=0 applicationID:SFInt32=0 entityID:SFInt32=0 forceID:SFInt32=0
  entityKind:SFInt32=0 entityDomain:SFInt32=0 entityCountry:SFInt32=0 entityCategory:SFInt32=0
  entitySubcategory:SFInt32=0 entitySpecific:SFInt32=0 entityExtra:SFInt32=0 readInterval:SFTime[0,]=0.1
  writeInterval:SFTime[0,]=1.0 networkMode:SFString=standAlone translation:SFVec3f=0,0,0 rotation:SFRotation=0,0,1,0
  scale:SFVec3f=1,1,1 scaleOrientation:SFRotation=0,0,1,0 center:SFVec3f=0,0,0 address:SFString=localhost
  port:SFInt32=0 multicastRelayHost:SFString multicastRelayPort:SFInt32=0 rtpHeaderExpected:SFBool=false
  deadReckoning:SFInt32=0 linearVelocity:SFVec3f=0,0,0 linearAcceleration:SFVec3f=0,0,0 fired1:SFBool=false
  fired2:SFBool=false collisionType:SFInt32=0 detonationLocation:SFVec3f=0,0,0
  detonationRelativeLocation:SFVec3f=0,0,0 detonationResult:SFInt32=0 eventApplicationID:SFInt32=0
  eventEntityID:SFInt32=0 eventNumber:SFInt32=0 eventSiteID:SFInt32=0 munitionStartPoint:SFVec3f=0,0,0
  munitionEndPoint:SFVec3f=0,0,0 munitionSiteID:SFInt32=0 munitionApplicationID:SFInt32=0 munitionEntityID:SFInt32=0
  fireMissionIndex:SFInt32=0 warhead:SFInt32=0 fuse:SFInt32=0 munitionQuantity:SFInt32=0 firingRate:SFInt32=0
  firingRange:SFFloat=0 articulationParameterCount:SFInt32=0 articulationParameterDesignatorArray:MFInt32
  articulationParameterChangeIndicatorArray:MFInt32 articulationParameterIdPartAttachedToArray:MFInt32
  articulationParameterTypeArray:MFInt32 articulationParameterArray:MFFloat geoSystem:MFString
  geoCoords:SFVec3d=0,0,0
ReceiverPdu@children:X3DNetworkSensorNode,X3DBoundedObject whichGeometry:SFInt32=1 readInterval:SFTime[0,]=0.1
  writeInterval:SFTime[0,]=1.0 networkMode:SFString=standAlone siteID:SFInt32=0 applicationID:SFInt32=0
  entityID:SFInt32=0 address:SFString=localhost port:SFInt32=0 multicastRelayHost:SFString
  multicastRelayPort:SFInt32=0 rtpHeaderExpected:SFBool=false radioID:SFInt32=0 receivedPower:SFFloat=0.0
  receiverState:SFInt32=0 transmitterSiteID:SFInt32=0 transmitterApplicationID:SFInt32=0
  transmitterEntityID:SFInt32=0 transmitterRadioID:SFInt32=0 geoSystem:MFString geoCoords:SFVec3d=0,0,0
SignalPdu@children:X3DNetworkSensorNode,X3DBoundedObject whichGeometry:SFInt32=1 readInterval:SFTime[0,]=0.1
  writeInterval:SFTime[0,]=1.0 networkMode:SFString=standAlone siteID:SFInt32=0 applicationID:SFInt32=0
  entityID:SFInt32=0 address:SFString=localhost port:SFInt32=0 multicastRelayHost:SFString
  multicastRelayPort:SFInt32=0 rtpHeaderExpected:SFBool=false radioID:SFInt32=0 encodingScheme:SFInt32=0
  tdlType:SFInt32=0 sampleRate:SFInt32=0 samples:SFInt32=0 dataLength:SFInt32=0 data:MFInt32 geoSystem:MFString
  geoCoords:SFVec3d=0,0,0
TransmitterPdu@children:X3DNetworkSensorNode,X3DBoundedObject whichGeometry:SFInt32=1 readInterval:SFTime[0,]=0.1
  writeInterval:SFTime[0,]=1.0 networkMode:SFString=standAlone siteID:SFInt32=0 applicationID:SFInt32=0
  entityID:SFInt32=0 address:SFString=localhost port:SFInt32=0 multicastRelayHost:SFString
  multicastRelayPort:SFInt32=0 rtpHeaderExpected:SFBool=false radioID:SFInt32=0 antennaLocation:SFVec3f=0,0,0
  antennaPatternLength:SFInt32=0 antennaPatternType:SFInt32=0 cryptoKeyID:SFInt32=0 cryptoSystem:SFInt32=0
  frequency:SFInt32[0,]=0 inputSource:SFInt32=0 lengthOfModulationParameters:SFInt32=0
  modulationTypeDetail:SFInt32=0 modulationTypeMajor:SFInt32=0 modulationTypeSpreadSpectrum:SFInt32=0
  modulationTypeSystem:SFInt32=0 power:SFFloat=0.0 radioEntityTypeCategory:SFInt32=0
  radioEntityTypeCountry:SFInt32=0 radioEntityTypeDomain:SFInt32=0 radioEntityTypeKind:SFInt32=0
  radioEntityTypeNomenclature:SFInt32=0 radioEntityTypeNomenclatureVersion:SFInt32=0
  relativeAntennaLocation:SFVec3f=0,0,0 transmitFrequencyBandwidth:SFFloat=0 transmitState:SFInt32=0
  geoSystem:MFString geoCoords:SFVec3d=0,0,0
GeoCoordinate@coord:X3DCoordinateNode geoSystem:MFString point:MFVec3d +geoOrigin:GeoOrigin
GeoElevationGrid@geometry:X3DGeometryNode geoSystem:MFString geoGridOrigin:SFVec3d=0,0,0 height:MFDouble=0,0
  ccw:SFBool=true colorPerVertex:SFBool=true creaseAngle:SFDouble[0,]=0 normalPerVertex:SFBool=true
  solid:SFBool=true xDimension:SFInt32[0,]=0 xSpacing:SFDouble(0,]=1.0 yScale:SFFloat[0,]=1 zDimension:SFInt32[0,]=0
  zSpacing:SFDouble(0,]=1.0 +color:X3DColorNode +normal:X3DNormalNode +geoOrigin:GeoOrigin
  +texCoord:X3DSingleTextureCoordinateNode
GeoLocation@children:X3DGroupingNode geoSystem:MFString geoCoords:SFVec3d=0,0,0 +geoOrigin:GeoOrigin
GeoLOD@children:X3DChildNode,X3DBoundedObject geoSystem:MFString rootUrl:MFString child1Url:MFString
  child2Url:MFString child3Url:MFString child4Url:MFString center:SFVec3d=0,0,0 range:SFFloat[0,]=10
  +geoOrigin:GeoOrigin +rootNode*:X3DChildNode
GeoMetadata@children:X3DInfoNode,X3DUrlObject summary:MFString +data*:X3DNode
GeoOrigin@geoOrigin:X3DNode geoSystem:MFString geoCoords:SFVec3d=0,0,0 rotateYUp:SFBool=false
GeoPositionInterpolator@children:X3DInterpolatorNode geoSystem:MFString keyValue:MFVec3d +geoOrigin:GeoOrigin
GeoProximitySensor@children:X3DEnvironmentalSensorNode center:SFVec3d=0,0,0 geoCenter:SFVec3d=0,0,0
  geoSystem:MFString +geoOrigin:GeoOrigin
GeoTouchSensor@children:X3DTouchSensorNode geoSystem:MFString +geoOrigin:GeoOrigin
GeoTransform@children:X3DGroupingNode geoCenter:SFVec3d=0,0,0 geoSystem:MFString rotation:SFRotation=0,0,1,0
  scale:SFVec3f=1,1,1 scaleOrientation:SFRotation=0,0,1,0 translation:SFVec3f=0,0,0 +geoOrigin:GeoOrigin
GeoViewpoint@children:X3DViewpointNode centerOfRotation:SFVec3d=0,0,0 geoSystem:MFString
  fieldOfView:SFFloat(0,3.1416)=0.7854 position:SFVec3d=0,0,100000 speedFactor:SFFloat[0,]=1.0 +geoOrigin:GeoOrigin
HAnimDisplacer@displacers:X3DGeometricPropertyNode name:SFString coordIndex:MFInt32 description:SFString
  displacements:MFVec3f weight:SFFloat=0.0
HAnimHumanoid@children:X3DChildNode,X3DBoundedObject center:SFVec3f=0,0,0 info:MFString description:SFString
  jointBindingPositions:MFVec3f jointBindingRotations:MFRotation jointBindingScales:MFVec3f loa:SFInt32[-1,4]=-1
  motionsEnabled:MFBool name:SFString rotation:SFRotation=0,0,1,0 scale:SFVec3f=1,1,1
  scaleOrientation:SFRotation=0,0,1,0 skeletalConfiguration:SFString=BASIC translation:SFVec3f=0,0,0
  version:SFString=2.0 +joints*:HAnimJoint +segments*:HAnimSegment +sites*:HAnimSite +skeleton*:HAnimJoint|HAnimSite
  +skin*:Group|Transform|Shape|IndexedFaceSet +skinCoord:Coordinate|CoordinateDouble +skinNormal:X3DNormalNode
  +viewpoints*:HAnimSite +motions*:HAnimMotion +skinBindingCoords:Coordinate|CoordinateDouble
  +skinBindingNormals:X3DNormalNode
HAnimJoint@children:X3DChildNode,X3DBoundedObject name:SFString center:SFVec3f=0,0,0 description:SFString
  rotation:SFRotation=0,0,1,0 scale:SFVec3f=1,1,1 scaleOrientation:SFRotation=0,0,1,0 translation:SFVec3f=0,0,0
  skinCoordIndex:MFInt32 skinCoordWeight:MFFloat llimit:MFFloat=0,0,0 ulimit:MFFloat=0,0,0
  limitOrientation:SFRotation=0,0,1,0 stiffness:MFFloat=0,0,0 +children*:HAnimJoint|HAnimSegment
  +displacers*:HAnimDisplacer
HAnimMotion@motions:X3DChildNode channels:SFString channelsEnabled:MFBool description:SFString enabled:SFBool=true
  endFrame:SFInt32[0,]=0 frameDuration:SFTime(0,]=0.1 frameIncrement:SFInt32=1 frameIndex:SFInt32[0,]=0
  joints:SFString loa:SFInt32[-1,4]=-1 loop:SFBool=false name:SFString startFrame:SFInt32[0,]=0 values:MFFloat
HAnimSegment@children:X3DGroupingNode name:SFString mass:SFFloat[0,]=0 centerOfMass:SFVec3f=0,0,0
  description:SFString momentsOfInertia:MFFloat=0,0,0,0,0,0,0,0,0 +coord:Coordinate|CoordinateDouble
  +displacers*:HAnimDisplacer
HAnimSite@children:X3DGroupingNode name:SFString center:SFVec3f=0,0,0 description:SFString
  rotation:SFRotation=0,0,1,0 scale:SFVec3f=1,1,1 scaleOrientation:SFRotation=0,0,1,0 translation:SFVec3f=0,0,0
Contour2D@trimmingContour:X3DNode +children*:NurbsCurve2D|ContourPolyline2D
ContourPolyline2D@children:X3DNurbsControlCurveNode
NurbsCurve@geometry:X3DParametricGeometryNode closed:SFBool=false knot:MFDouble order:SFInt32[2,]=3
  tessellation:SFInt32=0 weight:MFDouble +controlPoint:Coordinate|CoordinateDouble
NurbsCurve2D@children:X3DNurbsControlCurveNode closed:SFBool=false knot:MFDouble order:SFInt32[2,]=3
  tessellation:SFInt32=0 weight:MFDouble
NurbsOrientationInterpolator@children:X3DChildNode knot:MFDouble order:SFInt32[2,]=3 weight:MFDouble
  +controlPoint:Coordinate|CoordinateDouble
NurbsPatchSurface@geometry:X3DNurbsSurfaceGeometryNode
NurbsPositionInterpolator@children:X3DChildNode knot:MFDouble order:SFInt32[2,]=3 weight:MFDouble
  +controlPoint:Coordinate|CoordinateDouble
NurbsSet@children:X3DChildNode,X3DBoundedObject tessellationScale:SFFloat(0,]=1.0
  +geometry*:X3DParametricGeometryNode
NurbsSurfaceInterpolator@children:X3DChildNode uDimension:SFInt32[0,]=0 vDimension:SFInt32[0,]=0 uKnot:MFDouble
  vKnot:MFDouble uOrder:SFInt32[2,]=3 vOrder:SFInt32[2,]=3 weight:MFDouble +controlPoint:Coordinate|CoordinateDouble
NurbsSweptSurface@geometry:X3DParametricGeometryNode ccw:SFBool=true solid:SFBool=true
  +crossSectionCurve:X3DNurbsControlCurveNode +trajectoryCurve:NurbsCurve
NurbsSwungSurface@geometry:X3DParametricGeometryNode ccw:SFBool=true solid:SFBool=true
  +profileCurve:X3DNurbsControlCurveNode +trajectoryCurve:X3DNurbsControlCurveNode
NurbsTextureCoordinate@texCoord:X3DNode controlPoint:MFVec2f uDimension:SFInt32[0,]=0 vDimension:SFInt32[0,]=0
  uKnot:MFDouble vKnot:MFDouble uOrder:SFInt32[2,]=3 vOrder:SFInt32[2,]=3 weight:MFDouble
NurbsTrimmedSurface@geometry:X3DNurbsSurfaceGeometryNode +trimmingContour*:Contour2D
CADAssembly@children:X3DGroupingNode,X3DProductStructureChildNode name:SFString
CADFace@children:X3DProductStructureChildNode,X3DBoundedObject +shape:Shape|LOD|Transform
CADLayer@children:X3DGroupingNode name:SFString
CADPart@children:X3DProductStructureChildNode,X3DGroupingNode center:SFVec3f=0,0,0 rotation:SFRotation=0,0,1,0
  scale:SFVec3f=1,1,1 scaleOrientation:SFRotation=0,0,1,0 translation:SFVec3f=0,0,0 bboxCenter:SFVec3f=0,0,0
  bboxSize:SFVec3f=-1,-1,-1 bboxDisplay:SFBool=false visible:SFBool=true +children*:CADFace
IndexedQuadSet@geometry:X3DComposedGeometryNode index:MFInt32
QuadSet@geometry:X3DComposedGeometryNode
ComposedShader@shaders:X3DShaderNode,X3DProgrammableShaderObject language:SFString +field*:field +parts*:ShaderPart
FloatVertexAttribute@attrib:X3DVertexAttributeNode value:MFFloat numComponents:SFInt32[1,4]=4
Matrix3VertexAttribute@attrib:X3DVertexAttributeNode value:MFMatrix3f
Matrix4VertexAttribute@attrib:X3DVertexAttributeNode value:MFMatrix4f
PackagedShader@shaders:X3DUrlObject,X3DShaderNode,X3DProgrammableShaderObject language:SFString +field*:field
ProgramShader@shaders:X3DShaderNode +programs*:ShaderProgram
ShaderPart@parts:X3DNodeMixedContent,X3DUrlObject type:SFString=VERTEX
ShaderProgram@programs:X3DNodeMixedContent,X3DUrlObject,X3DProgrammableShaderObject type:SFString=VERTEX
  +field*:field
ComposedCubeMapTexture@texture:X3DEnvironmentTextureNode +backTexture:X3DTexture2DNode
  +bottomTexture:X3DTexture2DNode +frontTexture:X3DTexture2DNode +leftTexture:X3DTexture2DNode
  +rightTexture:X3DTexture2DNode +topTexture:X3DTexture2DNode +textureProperties:TextureProperties
GeneratedCubeMapTexture@texture:X3DEnvironmentTextureNode size:SFInt32(0,]=128 update:SFString=NONE
  +textureProperties:TextureProperties
ImageCubeMapTexture@texture:X3DEnvironmentTextureNode,X3DUrlObject +textureProperties:TextureProperties
ComposedTexture3D@texture:X3DTexture3DNode +texture*:X3DTexture2DNode
ImageTexture3D@texture:X3DTexture3DNode,X3DUrlObject
PixelTexture3D@texture:X3DTexture3DNode image:MFInt32=0,0,0,0
TextureCoordinate3D@texCoord:X3DSingleTextureCoordinateNode point:MFVec3f
TextureCoordinate4D@texCoord:X3DSingleTextureCoordinateNode point:MFVec4f
TextureTransformMatrix3D@textureTransform:X3DSingleTextureTransformNode
  matrix:SFMatrix4f=1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1
TextureTransform3D@textureTransform:X3DSingleTextureTransformNode center:SFVec3f=0,0,0 rotation:SFRotation=0,0,1,0
  scale:SFVec3f=1,1,1 translation:SFVec3f=0,0,0
OrthoViewpoint@children:X3DViewpointNode centerOfRotation:SFVec3f=0,0,0 fieldOfView:MFFloat=-1,-1,1,1
  position:SFVec3f=0,0,10
ViewpointGroup@children:X3DChildNode center:SFVec3f=0,0,0 description:SFString displayed:SFBool=true
  retainUserOffsets:SFBool=false size:SFVec3f=0,0,0 +children*:X3DViewpointNode|ViewpointGroup
Layer@layers:X3DLayerNode +children*:X3DChildNode
LayerSet@children:X3DNode activeLayer:SFInt32=0 order:MFInt32=0 +layers*:X3DLayerNode
Viewport@viewport:X3DViewportNode clipBoundary:MFFloat=0,1,0,1
Layout@layout:X3DLayoutNode align:MFString offset:MFFloat=0,0 offsetUnits:MFString scaleMode:MFString
  size:MFFloat=1,1 sizeUnits:MFString
LayoutGroup@children:X3DNode,X3DGroupingNode bboxCenter:SFVec3f=0,0,0 bboxSize:SFVec3f=-1,-1,-1
  bboxDisplay:SFBool=false visible:SFBool=true +children*:X3DChildNode +layout:X3DLayoutNode
  +viewport:X3DViewportNode
LayoutLayer@layers:X3DLayerNode +layout:X3DLayoutNode +children*:X3DChildNode
ScreenFontStyle@fontStyle:X3DFontStyleNode family:MFString horizontal:SFBool=true justify:MFString language:SFString
  leftToRight:SFBool=true pointSize:SFFloat(0,]=12.0 spacing:SFFloat[0,]=1.0 topToBottom:SFBool=true
ScreenGroup@children:X3DGroupingNode
BallJoint@joints:X3DRigidJointNode anchorPoint:SFVec3f=0,0,0
CollidableOffset@children:X3DNBodyCollidableNode +collidable:X3DNBodyCollidableNode
CollidableShape@children:X3DNBodyCollidableNode +shape:Shape
CollisionCollection@collider:X3DChildNode,X3DBoundedObject appliedParameters:MFString bounce:SFFloat[0,1]=0
  description:SFString enabled:SFBool=true frictionCoefficients:SFVec2f=0,0 minBounceSpeed:SFFloat[0,]=0.1
  slipFactors:SFVec2f=0,0 softnessConstantForceMix:SFFloat[0,1]=0.0001 softnessErrorCorrection:SFFloat[0,1]=0.8
  surfaceSpeed:SFVec2f=0,0 +collidables*:X3DNBodyCollisionSpaceNode|X3DNBodyCollidableNode
CollisionSensor@children:X3DSensorNode +collider:CollisionCollection
CollisionSpace@children:X3DNBodyCollisionSpaceNode useGeometry:SFBool=false
  +collidables*:X3DNBodyCollisionSpaceNode|X3DNBodyCollidableNode
Contact@contacts:X3DNode appliedParameters:MFString bounce:SFFloat[0,1]=0 contactNormal:SFVec3f=0,1,0
  depth:SFFloat=0 frictionCoefficients:SFVec2f=0,0 frictionDirection:SFVec3f=0,1,0 minBounceSpeed:SFFloat[0,]=0
  position:SFVec3f=0,0,0 slipCoefficients:SFVec2f=0,0 softnessConstantForceMix:SFFloat[0,1]=0.0001
  softnessErrorCorrection:SFFloat[0,1]=0.8 surfaceSpeed:SFVec2f=0,0 +body1:RigidBody +body2:RigidBody
  +geometry1:X3DNBodyCollidableNode +geometry2:X3DNBodyCollidableNode
DoubleAxisHingeJoint@joints:X3DRigidJointNode anchorPoint:SFVec3f=0,0,0 axis1:SFVec3f=1,0,0 axis2:SFVec3f=0,1,0
  desiredAngularVelocity1:SFFloat=0 desiredAngularVelocity2:SFFloat=0 maxAngle1:SFFloat=3.141592653
  maxTorque1:SFFloat=0 maxTorque2:SFFloat=0 minAngle1:SFFloat=-3.141592653 stop1Bounce:SFFloat=0
  stop1ConstantForceMix:SFFloat=0.001 stop1ErrorCorrection:SFFloat=0.8 suspensionErrorCorrection:SFFloat=0.8
  suspensionForce:SFFloat=0
MotorJoint@joints:X3DRigidJointNode autoCalc:SFBool=false axis1Angle:SFFloat=0 axis1Torque:SFFloat=0
  axis2Angle:SFFloat=0 axis2Torque:SFFloat=0 axis3Angle:SFFloat=0 axis3Torque:SFFloat=0 enabledAxes:SFInt32[0,3]=1
  motor1Axis:SFVec3f=1,0,0 motor2Axis:SFVec3f=0,1,0 motor3Axis:SFVec3f=0,0,1 stop1Bounce:SFFloat=0
  stop1ErrorCorrection:SFFloat=0.8 stop2Bounce:SFFloat=0 stop2ErrorCorrection:SFFloat=0.8 stop3Bounce:SFFloat=0
  stop3ErrorCorrection:SFFloat=0.8
RigidBody@bodies:X3DChildNode,X3DBoundedObject angularDampingFactor:SFFloat=0.001 angularVelocity:SFVec3f=0,0,0
  autoDamp:SFBool=false autoDisable:SFBool=false centerOfMass:SFVec3f=0,0,0 disableAngularSpeed:SFFloat=0
  disableLinearSpeed:SFFloat=0 disableTime:SFTime[0,]=0 enabled:SFBool=true finiteRotationAxis:SFVec3f=0,1,0
  fixed:SFBool=false forces:MFVec3f inertia:SFMatrix3f=1,0,0,0,1,0,0,0,1 linearDampingFactor:SFFloat=0.001
  linearVelocity:SFVec3f=0,0,0 mass:SFFloat=1 orientation:SFRotation=0,0,1,0 position:SFVec3f=0,0,0 torques:MFVec3f
  useFiniteRotation:SFBool=false useGlobalGravity:SFBool=true +geometry*:X3DNBodyCollidableNode
  +massDensityModel:Sphere|Box|Cone
RigidBodyCollection@children:X3DChildNode,X3DBoundedObject autoDisable:SFBool=false constantForceMix:SFFloat=0.0001
  contactSurfaceThickness:SFFloat=0 disableAngularSpeed:SFFloat=0 disableLinearSpeed:SFFloat=0
  disableTime:SFTime[0,]=0 enabled:SFBool=true errorCorrection:SFFloat=0.8 gravity:SFVec3f=0,-9.8,0
  iterations:SFInt32=10 maxCorrectionSpeed:SFFloat=-1 preferAccuracy:SFBool=false +bodies*:RigidBody
  +joints*:X3DRigidJointNode +collider:CollisionCollection
SingleAxisHingeJoint@joints:X3DRigidJointNode anchorPoint:SFVec3f=0,0,0 axis:SFVec3f=0,1,0
  maxAngle:SFFloat=3.141592653 minAngle:SFFloat=-3.141592653 stopBounce:SFFloat=0 stopErrorCorrection:SFFloat=0.8
SliderJoint@joints:X3DRigidJointNode axis:SFVec3f=0,1,0 maxSeparation:SFFloat=1 minSeparation:SFFloat=0
  sliderForce:SFFloat=0 stopBounce:SFFloat=0 stopErrorCorrection:SFFloat=1
UniversalJoint@joints:X3DRigidJointNode anchorPoint:SFVec3f=0,0,0 axis1:SFVec3f=1,0,0 axis2:SFVec3f=0,1,0
  stop1Bounce:SFFloat[0,1]=0 stop1ErrorCorrection:SFFloat[0,1]=0.8 stop2Bounce:SFFloat[0,1]=0
  stop2ErrorCorrection:SFFloat[0,1]=0.8
LinePickSensor@children:X3DPickSensorNode
PickableGroup@children:X3DGroupingNode,X3DPickableObject description:SFString
PointPickSensor@children:X3DPickSensorNode
PrimitivePickSensor@children:X3DPickSensorNode
VolumePickSensor@children:X3DPickSensorNode
ColorDamper@children:X3DDamperNode initialDestination:SFColor=0.8,0.8,0.8 initialValue:SFColor=0.8,0.8,0.8
CoordinateDamper@children:X3DDamperNode initialDestination:MFVec3f=0,0,0 initialValue:MFVec3f=0,0,0
OrientationDamper@children:X3DDamperNode initialDestination:SFRotation=0,1,0,0 initialValue:SFRotation=0,1,0,0
PositionDamper@children:X3DDamperNode initialDestination:SFVec3f=0,0,0 initialValue:SFVec3f=0,0,0
PositionDamper2D@children:X3DDamperNode initialDestination:SFVec2f=0,0 initialValue:SFVec2f=0,0
ScalarDamper@children:X3DDamperNode initialDestination:SFFloat=0 initialValue:SFFloat=0
TexCoordDamper2D@children:X3DDamperNode initialDestination:MFVec2f initialValue:MFVec2f
ColorChaser@children:X3DChaserNode initialDestination:SFColor=0.8,0.8,0.8 initialValue:SFColor=0.8,0.8,0.8
CoordinateChaser@children:X3DChaserNode initialDestination:MFVec3f=0,0,0 initialValue:MFVec3f=0,0,0
OrientationChaser@children:X3DChaserNode initialDestination:SFRotation=0,1,0,0 initialValue:SFRotation=0,1,0,0
PositionChaser@children:X3DChaserNode initialDestination:SFVec3f=0,0,0 initialValue:SFVec3f=0,0,0
PositionChaser2D@children:X3DChaserNode initialDestination:SFVec2f=0,0 initialValue:SFVec2f=0,0
ScalarChaser@children:X3DChaserNode initialDestination:SFFloat=0 initialValue:SFFloat=0
TexCoordChaser2D@children:X3DChaserNode initialDestination:MFVec2f initialValue:MFVec2f
BoundedPhysicsModel@physics:X3DParticlePhysicsModelNode +geometry:X3DGeometryNode
ForcePhysicsModel@physics:X3DParticlePhysicsModelNode force:SFVec3f=0,-9.8,0
WindPhysicsModel@physics:X3DParticlePhysicsModelNode direction:SFVec3f=1,0,0 gustiness:SFFloat[0,]=0.1
  speed:SFFloat[0,]=0.1 turbulence:SFFloat[0,1]=0
ConeEmitter@emitter:X3DParticleEmitterNode angle:SFFloat[0,3.1416]=0.7854 direction:SFVec3f=0,1,0
  position:SFVec3f=0,0,0
ExplosionEmitter@emitter:X3DParticleEmitterNode position:SFVec3f=0,0,0
PointEmitter@emitter:X3DParticleEmitterNode direction:SFVec3f=0,1,0 position:SFVec3f=0,0,0
PolylineEmitter@emitter:X3DParticleEmitterNode coordIndex:MFInt32=-1 direction:SFVec3f=0,1,0
  +coord:X3DCoordinateNode
SurfaceEmitter@emitter:X3DParticleEmitterNode +surface:X3DGeometryNode
VolumeEmitter@emitter:X3DParticleEmitterNode coordIndex:MFInt32=-1 direction:SFVec3f=0,1,0 internal:SFBool=true
  +coord:X3DCoordinateNode
ParticleSystem@children:X3DShapeNode createParticles:SFBool=true enabled:SFBool=true
  lifetimeVariation:SFFloat[0,1]=0.25 maxParticles:SFInt32[0,]=200 particleLifetime:SFFloat[0,]=5
  particleSize:SFVec2f=0.02,0.02 colorKey:MFFloat geometryType:SFString=QUAD texCoordKey:MFFloat +color:X3DColorNode
  +geometry:X3DGeometryNode +emitter:X3DParticleEmitterNode +physics*:X3DParticlePhysicsModelNode
  +texCoord:TextureCoordinate|TextureCoordinateGenerator
BlendedVolumeStyle@renderStyle:X3DComposableVolumeRenderStyleNode weightConstant1:SFFloat[0,1]=0.5
  weightConstant2:SFFloat[0,1]=0.5 weightFunction1:SFString=CONSTANT weightFunction2:SFString=CONSTANT
  +renderStyle:X3DComposableVolumeRenderStyleNode +voxels:X3DTexture3DNode +weightTransferFunction1:X3DTexture2DNode
  +weightTransferFunction2:X3DTexture2DNode
BoundaryEnhancementVolumeStyle@renderStyle:X3DComposableVolumeRenderStyleNode boundaryOpacity:SFFloat[0,1]=0.9
  opacityFactor:SFFloat[0,]=2 retainedOpacity:SFFloat[0,1]=0.2
CartoonVolumeStyle@renderStyle:X3DComposableVolumeRenderStyleNode colorSteps:SFInt32[1,64]=4
  orthogonalColor:SFColorRGBA=1,1,1,1 parallelColor:SFColorRGBA=0,0,0,1 +surfaceNormals:X3DTexture3DNode
ComposedVolumeStyle@renderStyle:X3DComposableVolumeRenderStyleNode +renderStyle*:X3DComposableVolumeRenderStyleNode
EdgeEnhancementVolumeStyle@renderStyle:X3DComposableVolumeRenderStyleNode edgeColor:SFColorRGBA=0,0,0,1
  gradientThreshold:SFFloat[0,3.1416]=0.4 +surfaceNormals:X3DTexture3DNode
IsoSurfaceVolumeData@children:X3DVolumeDataNode contourStepSize:SFFloat=0 surfaceTolerance:SFFloat[0,]=0
  surfaceValues:MFFloat +gradients:X3DTexture3DNode +renderStyle*:X3DVolumeRenderStyleNode +voxels:X3DTexture3DNode
OpacityMapVolumeStyle@renderStyle:X3DComposableVolumeRenderStyleNode
  +transferFunction:X3DTexture2DNode|X3DTexture3DNode
ProjectionVolumeStyle@renderStyle:X3DVolumeRenderStyleNode intensityThreshold:SFFloat[0,1]=0 type:SFString=MAX
SegmentedVolumeData@children:X3DVolumeDataNode segmentEnabled:MFBool +renderStyle*:X3DVolumeRenderStyleNode
  +segmentIdentifiers:X3DTexture3DNode +voxels:X3DTexture3DNode
ShadedVolumeStyle@renderStyle:X3DComposableVolumeRenderStyleNode lighting:SFBool=false shadows:SFBool=false
  phaseFunction:SFString=Henyey-Greenstein +material:X3DMaterialNode +surfaceNormals:X3DTexture3DNode
SilhouetteEnhancementVolumeStyle@renderStyle:X3DComposableVolumeRenderStyleNode
  silhouetteBoundaryOpacity:SFFloat[0,1]=0 silhouetteRetainedOpacity:SFFloat[0,1]=1
  silhouetteSharpness:SFFloat[0,]=0.5 +surfaceNormals:X3DTexture3DNode
ToneMappedVolumeStyle@renderStyle:X3DComposableVolumeRenderStyleNode coolColor:SFColorRGBA=0,0,1,0
  warmColor:SFColorRGBA=1,1,0,0 +surfaceNormals:X3DTexture3DNode
VolumeData@children:X3DVolumeDataNode +renderStyle:X3DVolumeRenderStyleNode +voxels:X3DTexture3DNode
TextureProjector@children:X3DTextureProjectorNode fieldOfView:SFFloat[0,3.1416]=0.7854
TextureProjectorParallel@children:X3DTextureProjectorNode fieldOfView:SFVec4f=-1,-1,1,1
PhysicalMaterial@material:X3DOneSidedMaterialNode baseColor:SFColor=1,1,1 baseTextureMapping:SFString
  emissiveColor:SFColor=0,0,0 metallic:SFFloat[0,1]=1 metallicRoughnessTextureMapping:SFString
  occlusionStrength:SFFloat[0,1]=1 occlusionTextureMapping:SFString roughness:SFFloat[0,1]=1
  transparency:SFFloat[0,1]=0 +baseTexture:X3DSingleTextureNode +emissiveTexture:X3DSingleTextureNode
  +metallicRoughnessTexture:X3DSingleTextureNode +normalTexture:X3DSingleTextureNode
  +occlusionTexture:X3DSingleTextureNode
UnlitMaterial@material:X3DOneSidedMaterialNode transparency:SFFloat[0,1]=0 emissiveColor:SFColor=1,1,1
  +emissiveTexture:X3DSingleTextureNode +normalTexture:X3DSingleTextureNode
AcousticProperties@acousticProperties:X3DAppearanceChildNode absorption:SFFloat[0,1]=0 description:SFString
  diffuse:SFFloat[0,1]=0 enabled:SFBool=true refraction:SFFloat[0,1]=0 specular:SFFloat[0,1]=0
Analyser@children:X3DSoundProcessingNode fftSize:SFInt32[0,]=2048 frequencyBinCount:SFInt32[0,]=1024
  minDecibels:SFFloat=-100 maxDecibels:SFFloat=-30 smoothingTimeConstant:SFFloat[0,]=0.8
  +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
BufferAudioSource@children:X3DSoundSourceNode,X3DUrlObject buffer:MFFloat bufferDuration:SFTime[0,]=0
  channelCountMode:SFString=MAX channelInterpretation:SFString=SPEAKERS detune:SFFloat[0,]=0 loop:SFBool=false
  loopEnd:SFFloat[0,]=0 loopStart:SFFloat[0,]=0 numberOfChannels:SFInt32[0,]=0 playbackRate:SFFloat=1
  sampleRate:SFFloat[0,]=0
AudioDestination@children:X3DSoundDestinationNode maxChannelCount:SFInt32[0,]=2
  +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
BiquadFilter@children:X3DSoundProcessingNode detune:SFFloat[0,]=0 frequency:SFFloat[0,]=350
  qualityFactor:SFFloat[0,]=1 type:SFString=LOWPASS
  +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
ChannelMerger@children:X3DSoundChannelNode +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
ChannelSelector@children:X3DSoundChannelNode channelSelection:SFInt32[0,]=0
  +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
ChannelSplitter@children:X3DSoundChannelNode +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
Convolver@children:X3DSoundProcessingNode buffer:MFFloat normalize:SFBool=false
  +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
Delay@children:X3DSoundProcessingNode delayTime:SFTime[0,]=0 maxDelayTime:SFTime[0,]=1
  +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
DynamicsCompressor@children:X3DSoundProcessingNode attack:SFTime[0,]=0.003 knee:SFFloat[0,]=30
  ratio:SFFloat[1,20]=12 release:SFTime[0,]=0.25 threshold:SFFloat[-100,0]=-24
  +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
Gain@children:X3DSoundProcessingNode +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
ListenerPointSource@children:X3DSoundSourceNode dopplerEnabled:SFBool=false interauralDistance:SFFloat[0,]=0
  orientation:SFRotation=0,0,1,0 position:SFVec3f=0,0,0 trackCurrentView:SFBool=false
MicrophoneSource@children:X3DSoundSourceNode mediaDeviceID:SFString
OscillatorSource@children:X3DSoundSourceNode detune:SFFloat[0,]=0 frequency:SFFloat[0,]=440
  +periodicWave:PeriodicWave
PeriodicWave@periodicWave:X3DSoundNode optionsReal:MFFloat optionsImag:MFFloat type:SFString=SQUARE
StreamAudioDestination@children:X3DSoundDestinationNode streamIdentifier:MFString
  +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
StreamAudioSource@children:X3DSoundSourceNode channelCountMode:SFString=MAX channelInterpretation:SFString=SPEAKERS
  streamIdentifier:MFString
WaveShaper@children:X3DSoundProcessingNode curve:MFFloat oversample:SFString=NONE
  +children*:X3DSoundNode|X3DSoundSourceNode|X3DSoundProcessingNode
)X3D";
// clang-format on

}  // namespace mechane::scenario
