// The exhibits that a draft can begin as.
#include <algorithm>
#include <array>

#include "client-sdk/studio/edits/parts.hpp"

namespace mechane::studio {
namespace {

constexpr std::string_view kEmpty = R"(<?xml version='1.0' encoding='UTF-8'?>
<X3D profile='Interactive' version='4.0'>
  <head>
    <component name='RigidBodyPhysics' level='2'/>
    <meta name='license' content='Apache-2.0'/>
  </head>
  <Scene>
    <WorldInfo title='A new exhibit'>
      <MetadataSet containerField='metadata' name='mechane:scenario'>
        <MetadataInteger containerField='value' name='format' value='1'/>
        <MetadataString containerField='value' name='id' value='"$ID"'/>
        <MetadataString containerField='value' name='languages' value='"el" "en"'/>
        <MetadataSet containerField='value' name='text'>
          <MetadataString containerField='value' name='title.el' value='"Ένα νέο έκθεμα"'/>
          <MetadataString containerField='value' name='title.en' value='"A new exhibit"'/>
        </MetadataSet>
        <MetadataSet containerField='value' name='agents'>
          <MetadataSet containerField='value' name='HOLD'>
            <MetadataString containerField='value' name='type' value='"simulation.grasp"'/>
          </MetadataSet>
        </MetadataSet>
        <MetadataSet containerField='value' name='quantities'>
          <MetadataString containerField='value' name='hands' value='"HOLD.active"'/>
        </MetadataSet>
        <MetadataSet containerField='value' name='activities'>
          <MetadataSet containerField='value' name='try'>
            <MetadataSet containerField='value' name='text'>
              <MetadataString containerField='value' name='title.el' value='"Δοκιμάστε"'/>
              <MetadataString containerField='value' name='title.en' value='"Try it"'/>
              <MetadataString containerField='value' name='goal.el' value='"Τι θα μάθουν εδώ οι επισκέπτες."'/>
              <MetadataString containerField='value' name='goal.en' value='"What visitors learn here."'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='steps'>
              <MetadataSet containerField='value' name='first'>
                <MetadataSet containerField='value' name='text'>
                  <MetadataString containerField='value' name='caption.el' value='"Πιάστε τη σφαίρα."'/>
                  <MetadataString containerField='value' name='caption.en' value='"Take the ball."'/>
                </MetadataSet>
                <MetadataSet containerField='value' name='trigger:1'>
                  <MetadataString containerField='value' name='quantity' value='"hands"'/>
                  <MetadataString containerField='value' name='op' value='">"'/>
                  <MetadataDouble containerField='value' name='value' value='0'/>
                  <MetadataString containerField='value' name='next' value='"end"'/>
                </MetadataSet>
              </MetadataSet>
            </MetadataSet>
          </MetadataSet>
        </MetadataSet>
        <MetadataSet containerField='value' name='visits'>
          <MetadataSet containerField='value' name='trying'>
            <MetadataString containerField='value' name='activity' value='"try"'/>
            <MetadataSet containerField='value' name='move:1'>
              <MetadataString containerField='value' name='kind' value='"reach"'/>
              <MetadataString containerField='value' name='body' value='"BALL"'/>
              <MetadataDouble containerField='value' name='grip' value='0 0.03 0'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='move:2'>
              <MetadataString containerField='value' name='kind' value='"grasp"'/>
              <MetadataString containerField='value' name='body' value='"BALL"'/>
            </MetadataSet>
          </MetadataSet>
        </MetadataSet>
      </MetadataSet>
    </WorldInfo>
    <Viewpoint DEF='FRONT' description='front' position='0 1.1 2.2' orientation='1 0 0 -0.15'/>
    <RigidBodyCollection gravity='0 -9.81 0'>
      <RigidBody DEF='TABLE' fixed='true' position='0 0.7 0'>
        <CollidableShape containerField='geometry'>
          <Shape containerField='shape'>
            <Appearance><Material diffuseColor='0.5 0.4 0.3'/></Appearance>
            <Box size='1 0.1 0.6'/>
          </Shape>
        </CollidableShape>
      </RigidBody>
      <RigidBody DEF='BALL' mass='0.63' inertia='0.0009 0 0 0 0.0009 0 0 0 0.0009' position='0 0.81 0.1'>
        <MetadataSet containerField='metadata' name='mechane'>
          <MetadataSet containerField='value' name='mechane:body'>
            <MetadataSet containerField='value' name='text'>
              <MetadataString containerField='value' name='title.el' value='"Η σφαίρα"'/>
              <MetadataString containerField='value' name='title.en' value='"The ball"'/>
            </MetadataSet>
          </MetadataSet>
          <MetadataSet containerField='value' name='mechane:haptic'>
            <MetadataDouble containerField='value' name='effortScale' value='0.2'/>
            <MetadataBoolean containerField='value' name='graspable' value='true'/>
          </MetadataSet>
        </MetadataSet>
        <CollidableShape containerField='geometry'>
          <Shape containerField='shape'>
            <Appearance><Material diffuseColor='0.6 0.35 0.2'/></Appearance>
            <Sphere radius='0.06'/>
          </Shape>
        </CollidableShape>
      </RigidBody>
    </RigidBodyCollection>
  </Scene>
</X3D>
)";

constexpr std::string_view kLever = R"(<?xml version='1.0' encoding='UTF-8'?>
<X3D profile='Interactive' version='4.0'>
  <head>
    <component name='RigidBodyPhysics' level='2'/>
    <meta name='license' content='Apache-2.0'/>
  </head>
  <Scene>
    <WorldInfo title='A lever and a weight'>
      <MetadataSet containerField='metadata' name='mechane:scenario'>
        <MetadataInteger containerField='value' name='format' value='1'/>
        <MetadataString containerField='value' name='id' value='"$ID"'/>
        <MetadataString containerField='value' name='languages' value='"el" "en"'/>
        <!-- The hand feels a tenth of what the lever asks. -->
        <MetadataDouble containerField='value' name='effortScale' value='0.1'/>
        <MetadataSet containerField='value' name='text'>
          <MetadataString containerField='value' name='title.el' value='"Ο μοχλός και το βάρος"'/>
          <MetadataString containerField='value' name='title.en' value='"The lever and the weight"'/>
        </MetadataSet>
        <MetadataSet containerField='value' name='agents'>
          <MetadataSet containerField='value' name='HOLD'>
            <MetadataString containerField='value' name='type' value='"simulation.grasp"'/>
            <MetadataString containerField='value' name='bodies' value='"LEVER"'/>
            <MetadataDouble containerField='value' name='torqueLimit' value='0.005'/>
            <MetadataDouble containerField='value' name='breakDistance' value='0.15'/>
          </MetadataSet>
        </MetadataSet>
        <MetadataSet containerField='value' name='quantities'>
          <MetadataString containerField='value' name='angle' value='"PIVOT.angle"'/>
        </MetadataSet>
        <MetadataSet containerField='value' name='activities'>
          <MetadataSet containerField='value' name='lift'>
            <MetadataSet containerField='value' name='text'>
              <MetadataString containerField='value' name='title.el' value='"Σηκώστε το βάρος"'/>
              <MetadataString containerField='value' name='title.en' value='"Lift the weight"'/>
              <MetadataString containerField='value' name='goal.el' value='"Ο μακρύς βραχίονας κάνει το βάρος ελαφρύ."'/>
              <MetadataString containerField='value' name='goal.en' value='"A long arm makes the weight light."'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='steps'>
              <MetadataSet containerField='value' name='press'>
                <MetadataSet containerField='value' name='text'>
                  <MetadataString containerField='value' name='caption.el' value='"Πιάστε τη λαβή και πιέστε την προς τα κάτω."'/>
                  <MetadataString containerField='value' name='caption.en' value='"Take the handle and press it down."'/>
                </MetadataSet>
                <MetadataSet containerField='value' name='trigger:1'>
                  <MetadataString containerField='value' name='quantity' value='"angle"'/>
                  <MetadataString containerField='value' name='op' value='"&lt;"'/>
                  <MetadataDouble containerField='value' name='value' value='-0.3'/>
                  <MetadataString containerField='value' name='next' value='"end"'/>
                </MetadataSet>
              </MetadataSet>
            </MetadataSet>
          </MetadataSet>
        </MetadataSet>
        <MetadataSet containerField='value' name='visits'>
          <MetadataSet containerField='value' name='lifting'>
            <MetadataString containerField='value' name='activity' value='"lift"'/>
            <MetadataSet containerField='value' name='move:1'>
              <MetadataString containerField='value' name='kind' value='"reach"'/>
              <MetadataString containerField='value' name='body' value='"LEVER"'/>
              <MetadataDouble containerField='value' name='grip' value='0.6 0 0'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='move:2'>
              <MetadataString containerField='value' name='kind' value='"grasp"'/>
              <MetadataString containerField='value' name='body' value='"LEVER"'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='move:3'>
              <MetadataString containerField='value' name='kind' value='"turn"'/>
              <MetadataString containerField='value' name='joint' value='"PIVOT"'/>
              <MetadataDouble containerField='value' name='turns' value='-0.06'/>
              <MetadataDouble containerField='value' name='rpm' value='4'/>
            </MetadataSet>
          </MetadataSet>
        </MetadataSet>
      </MetadataSet>
    </WorldInfo>
    <Viewpoint DEF='FRONT' description='front' position='0.1 1.2 2.4' orientation='1 0 0 -0.12'/>
    <RigidBodyCollection gravity='0 -9.81 0'>
      <RigidBody DEF='POST' fixed='true' position='0 0.45 -0.08'>
        <CollidableShape containerField='geometry'>
          <Shape containerField='shape'>
            <Appearance><Material diffuseColor='0.45 0.38 0.3'/></Appearance>
            <Box size='0.1 0.9 0.06'/>
          </Shape>
        </CollidableShape>
      </RigidBody>
      <!-- The beam, a weight of 8 kg at its short arm and a handle at the long one. Origin at the pivot. -->
      <RigidBody DEF='LEVER' mass='12' centerOfMass='-0.1 0 0' inertia='0.04 0 0 0 0.9 0 0 0 0.9' position='0 0.95 0'
        autoDamp='true' angularDampingFactor='0.3'>
        <MetadataSet containerField='metadata' name='mechane'>
          <MetadataSet containerField='value' name='mechane:body'>
            <MetadataBoolean containerField='value' name='collides' value='false'/>
            <MetadataSet containerField='value' name='text'>
              <MetadataString containerField='value' name='title.el' value='"Ο μοχλός"'/>
              <MetadataString containerField='value' name='title.en' value='"The lever"'/>
            </MetadataSet>
          </MetadataSet>
          <MetadataSet containerField='value' name='mechane:haptic'>
            <MetadataDouble containerField='value' name='effortScale' value='0.1'/>
            <MetadataBoolean containerField='value' name='graspable' value='true'/>
          </MetadataSet>
        </MetadataSet>
        <CollidableShape containerField='geometry' translation='0.15 0 0'>
          <Shape containerField='shape'>
            <Appearance DEF='WOOD'><Material diffuseColor='0.55 0.4 0.25'/></Appearance>
            <Box size='1 0.05 0.05'/>
          </Shape>
        </CollidableShape>
        <CollidableShape containerField='geometry' translation='-0.28 0.1 0'>
          <Shape containerField='shape'>
            <Appearance><Material diffuseColor='0.6 0.6 0.58'/></Appearance>
            <Box size='0.14 0.14 0.14'/>
          </Shape>
        </CollidableShape>
      </RigidBody>
      <SingleAxisHingeJoint DEF='PIVOT' anchorPoint='0 0.95 0' axis='0 0 1' minAngle='-0.45' maxAngle='0.02'>
        <MetadataSet containerField='metadata' name='mechane:agent'>
          <MetadataString containerField='value' name='type' value='"geometry.hinge"'/>
        </MetadataSet>
        <RigidBody containerField='body1' USE='POST'/>
        <RigidBody containerField='body2' USE='LEVER'/>
      </SingleAxisHingeJoint>
    </RigidBodyCollection>
  </Scene>
</X3D>
)";

constexpr std::string_view kCrank = R"(<?xml version='1.0' encoding='UTF-8'?>
<X3D profile='Interactive' version='4.0'>
  <head>
    <component name='RigidBodyPhysics' level='2'/>
    <meta name='license' content='Apache-2.0'/>
  </head>
  <Scene>
    <WorldInfo title='A crank and a rope'>
      <MetadataSet containerField='metadata' name='mechane:scenario'>
        <MetadataInteger containerField='value' name='format' value='1'/>
        <MetadataString containerField='value' name='id' value='"$ID"'/>
        <MetadataString containerField='value' name='languages' value='"el" "en"'/>
        <!-- The hand feels a twenty-fifth of what the crank asks. -->
        <MetadataDouble containerField='value' name='effortScale' value='0.04'/>
        <MetadataSet containerField='value' name='text'>
          <MetadataString containerField='value' name='title.el' value='"Η μανιβέλα και το σχοινί"'/>
          <MetadataString containerField='value' name='title.en' value='"The crank and the rope"'/>
        </MetadataSet>
        <MetadataSet containerField='value' name='agents'>
          <MetadataSet containerField='value' name='HOLD'>
            <MetadataString containerField='value' name='type' value='"simulation.grasp"'/>
            <MetadataString containerField='value' name='bodies' value='"DRUM"'/>
            <MetadataDouble containerField='value' name='torqueLimit' value='0.005'/>
            <MetadataDouble containerField='value' name='breakDistance' value='0.12'/>
          </MetadataSet>
          <MetadataSet containerField='value' name='RATCHET'>
            <MetadataString containerField='value' name='type' value='"geometry.ratchet"'/>
            <MetadataString containerField='value' name='joint' value='"AXLE"'/>
            <MetadataDouble containerField='value' name='teeth' value='16'/>
          </MetadataSet>
          <!-- From the drum over the beam's end to the load. -->
          <MetadataSet containerField='value' name='ROPE'>
            <MetadataString containerField='value' name='type' value='"geometry.rope"'/>
            <MetadataDouble containerField='value' name='diameter' value='0.012'/>
            <MetadataString containerField='value' name='drum' value='"AXLE"'/>
            <MetadataDouble containerField='value' name='drumRadius' value='0.06'/>
            <MetadataString containerField='value' name='bodies' value='"FRAME" "LOAD"'/>
            <MetadataDouble containerField='value' name='points' value='-0.4 0.9 0  0 0.1 0'/>
            <MetadataDouble containerField='value' name='radii' value='0.05 0'/>
          </MetadataSet>
        </MetadataSet>
        <MetadataSet containerField='value' name='quantities'>
          <MetadataString containerField='value' name='height' value='"LOAD.position.y"'/>
        </MetadataSet>
        <MetadataSet containerField='value' name='activities'>
          <MetadataSet containerField='value' name='lift'>
            <MetadataSet containerField='value' name='text'>
              <MetadataString containerField='value' name='title.el' value='"Σηκώστε το φορτίο"'/>
              <MetadataString containerField='value' name='title.en' value='"Lift the load"'/>
              <MetadataString containerField='value' name='goal.el' value='"Η μανιβέλα τυλίγει το σχοινί και σηκώνει το φορτίο."'/>
              <MetadataString containerField='value' name='goal.en' value='"The crank winds the rope and lifts the load."'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='steps'>
              <MetadataSet containerField='value' name='wind'>
                <MetadataSet containerField='value' name='text'>
                  <MetadataString containerField='value' name='caption.el' value='"Πιάστε τη λαβή και γυρίστε τη μανιβέλα."'/>
                  <MetadataString containerField='value' name='caption.en' value='"Take the handle and turn the crank."'/>
                </MetadataSet>
                <MetadataSet containerField='value' name='trigger:1'>
                  <MetadataString containerField='value' name='quantity' value='"height"'/>
                  <MetadataString containerField='value' name='op' value='">"'/>
                  <MetadataDouble containerField='value' name='value' value='0.6'/>
                  <MetadataString containerField='value' name='next' value='"end"'/>
                </MetadataSet>
              </MetadataSet>
            </MetadataSet>
          </MetadataSet>
        </MetadataSet>
        <MetadataSet containerField='value' name='visits'>
          <MetadataSet containerField='value' name='lifting'>
            <MetadataString containerField='value' name='activity' value='"lift"'/>
            <MetadataSet containerField='value' name='move:1'>
              <MetadataString containerField='value' name='kind' value='"reach"'/>
              <MetadataString containerField='value' name='body' value='"DRUM"'/>
              <MetadataDouble containerField='value' name='grip' value='0 0.25 0.3'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='move:2'>
              <MetadataString containerField='value' name='kind' value='"grasp"'/>
              <MetadataString containerField='value' name='body' value='"DRUM"'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='move:3'>
              <MetadataString containerField='value' name='kind' value='"turn"'/>
              <MetadataString containerField='value' name='joint' value='"AXLE"'/>
              <MetadataDouble containerField='value' name='turns' value='1.5'/>
            </MetadataSet>
          </MetadataSet>
        </MetadataSet>
      </MetadataSet>
    </WorldInfo>
    <Viewpoint DEF='FRONT' description='front' position='-0.1 1.2 2.8' orientation='1 0 0 -0.12'/>
    <RigidBodyCollection gravity='0 -9.81 0' iterations='20'>
      <!-- A post with an arm, whose end the rope runs over. -->
      <RigidBody DEF='FRAME' fixed='true' position='0 0.9 -0.1'>
        <MetadataSet containerField='metadata' name='mechane:body'>
          <MetadataBoolean containerField='value' name='collides' value='false'/>
        </MetadataSet>
        <CollidableShape containerField='geometry'>
          <Shape containerField='shape'>
            <Appearance DEF='WOOD'><Material diffuseColor='0.45 0.38 0.3'/></Appearance>
            <Box size='0.1 1.8 0.08'/>
          </Shape>
        </CollidableShape>
        <CollidableShape containerField='geometry' translation='-0.2 0.83 0.05'>
          <Shape containerField='shape'>
            <Appearance USE='WOOD'/>
            <Box size='0.4 0.06 0.06'/>
          </Shape>
        </CollidableShape>
      </RigidBody>
      <RigidBody DEF='GROUND' fixed='true' position='-0.3 0.15 0'>
        <CollidableShape containerField='geometry'>
          <Shape containerField='shape'>
            <Appearance><Material diffuseColor='0.6 0.6 0.58'/></Appearance>
            <Box size='0.6 0.3 0.4'/>
          </Shape>
        </CollidableShape>
      </RigidBody>
      <!-- A log with a crank. Its axle is along z; taken as balanced. -->
      <RigidBody DEF='DRUM' mass='5' inertia='0.08 0 0 0 0.08 0 0 0 0.03' position='0.1 0.9 0' autoDamp='true' angularDampingFactor='0.1'>
        <MetadataSet containerField='metadata' name='mechane'>
          <MetadataSet containerField='value' name='mechane:body'>
            <MetadataBoolean containerField='value' name='collides' value='false'/>
            <MetadataSet containerField='value' name='text'>
              <MetadataString containerField='value' name='title.el' value='"Η μανιβέλα"'/>
              <MetadataString containerField='value' name='title.en' value='"The crank"'/>
            </MetadataSet>
          </MetadataSet>
          <MetadataSet containerField='value' name='mechane:haptic'>
            <MetadataDouble containerField='value' name='effortScale' value='0.04'/>
            <MetadataBoolean containerField='value' name='graspable' value='true'/>
          </MetadataSet>
        </MetadataSet>
        <CollidableShape containerField='geometry' translation='0 0 0.05' rotation='1 0 0 1.5708'>
          <Shape containerField='shape'>
            <Appearance USE='WOOD'/>
            <Cylinder radius='0.055' height='0.3'/>
          </Shape>
        </CollidableShape>
        <CollidableShape containerField='geometry' translation='0 0.12 0.215'>
          <Shape containerField='shape'>
            <Appearance><Material diffuseColor='0.4 0.4 0.42'/></Appearance>
            <Box size='0.05 0.3 0.03'/>
          </Shape>
        </CollidableShape>
        <CollidableShape containerField='geometry' translation='0 0.25 0.3' rotation='1 0 0 1.5708'>
          <Shape containerField='shape'>
            <Appearance USE='WOOD'/>
            <Cylinder radius='0.02' height='0.14'/>
          </Shape>
        </CollidableShape>
      </RigidBody>
      <RigidBody DEF='LOAD' mass='10' inertia='0.05 0 0 0 0.05 0 0 0 0.05' position='-0.45 0.39 -0.1'
        autoDamp='true' linearDampingFactor='0.3' angularDampingFactor='0.5'>
        <MetadataSet containerField='metadata' name='mechane:haptic'>
          <MetadataDouble containerField='value' name='effortScale' value='0.04'/>
        </MetadataSet>
        <CollidableShape containerField='geometry'>
          <Shape containerField='shape'>
            <Appearance><Material diffuseColor='0.65 0.63 0.58'/></Appearance>
            <Box size='0.18 0.18 0.18'/>
          </Shape>
        </CollidableShape>
      </RigidBody>
      <SingleAxisHingeJoint DEF='AXLE' anchorPoint='0.1 0.9 0' axis='0 0 1'>
        <MetadataSet containerField='metadata' name='mechane:agent'>
          <MetadataString containerField='value' name='type' value='"geometry.hinge"'/>
          <MetadataDouble containerField='value' name='frictionTorque' value='0.2'/>
        </MetadataSet>
        <RigidBody containerField='body1' USE='FRAME'/>
        <RigidBody containerField='body2' USE='DRUM'/>
      </SingleAxisHingeJoint>
    </RigidBodyCollection>
  </Scene>
</X3D>
)";

constexpr std::array<Template, 3> kTemplates{{
    {"empty", "Κενό έκθεμα", "An empty exhibit", kEmpty},
    {"lever-and-weight", "Μοχλός και βάρος", "A lever and a weight", kLever},
    {"crank-and-rope", "Μανιβέλα και σχοινί", "A crank and a rope", kCrank},
}};

}  // namespace

std::span<const Template> templates() {
  return kTemplates;
}

const Template* find_template(std::string_view name) {
  const auto found = std::ranges::find(kTemplates, name, &Template::name);
  return found == kTemplates.end() ? nullptr : &*found;
}

std::string text_of(const Template& a_template, std::string_view id) {
  std::string text(a_template.text);
  constexpr std::string_view kId = "$ID";
  text.replace(text.find(kId), kId.size(), id);
  return text;
}

}  // namespace mechane::studio
