#include "client-sdk/authoring/reference_example.hpp"

#include <algorithm>

#include "server/base/assert.hpp"

namespace mechane::authoring {
namespace {

constexpr std::string_view kShapes = R"(<X3D version='4.0' profile='Full'>
  <Scene>
    <RigidBodyCollection gravity='0 -9.81 0'>
      <RigidBody DEF='TABLE' containerField='bodies' fixed='true' position='0 0.7 0'>
        <CollidableShape containerField='geometry'><Shape containerField='shape'><Box size='1 0.1 0.6'/></Shape></CollidableShape>
      </RigidBody>
      <RigidBody DEF='BALL' containerField='bodies' mass='0.4' position='0 1 0'>
        <CollidableShape containerField='geometry'><Shape containerField='shape'><Sphere radius='0.06'/></Shape></CollidableShape>
      </RigidBody>
    </RigidBodyCollection>
  </Scene>
</X3D>
)";

constexpr std::string_view kExample = R"(<?xml version='1.0' encoding='UTF-8'?>
<X3D profile='Interactive' version='4.0'>
  <head>
    <component name='RigidBodyPhysics' level='2'/>
    <component name='Networking' level='2'/>
  </head>
  <Scene>
    <WorldInfo title='A wheel'>
      <MetadataSet containerField='metadata' name='mechane:scenario'>
        <MetadataInteger containerField='value' name='format' value='1'/>
        <MetadataString containerField='value' name='id' value='"wheel"'/>
        <MetadataString containerField='value' name='languages' value='"en"'/>
        <MetadataSet containerField='value' name='text'>
          <MetadataString containerField='value' name='title.en' value='"The wheel"'/>
        </MetadataSet>
        <MetadataSet containerField='value' name='agents'>
          <MetadataSet containerField='value' name='HOLD'>
            <MetadataString containerField='value' name='type' value='"simulation.grasp"'/>
            <MetadataString containerField='value' name='bodies' value='"WHEEL"'/>
          </MetadataSet>
        </MetadataSet>
        <MetadataSet containerField='value' name='quantities'>
          <MetadataString containerField='value' name='turns' value='"AXLE.turns"'/>
        </MetadataSet>
        <MetadataSet containerField='value' name='activities'>
          <MetadataSet containerField='value' name='turn'>
            <MetadataSet containerField='value' name='text'>
              <MetadataString containerField='value' name='title.en' value='"Turn the wheel"'/>
              <MetadataString containerField='value' name='goal.en' value='"A wheel turns easily about its axle."'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='steps'>
              <MetadataSet containerField='value' name='once'>
                <MetadataSet containerField='value' name='text'>
                  <MetadataString containerField='value' name='caption.en' value='"Take the rim and turn the wheel once."'/>
                </MetadataSet>
                <MetadataSet containerField='value' name='trigger:1'>
                  <MetadataString containerField='value' name='quantity' value='"turns"'/>
                  <MetadataString containerField='value' name='op' value='">"'/>
                  <MetadataDouble containerField='value' name='value' value='1'/>
                  <MetadataString containerField='value' name='next' value='"end"'/>
                </MetadataSet>
              </MetadataSet>
            </MetadataSet>
          </MetadataSet>
        </MetadataSet>
        <MetadataSet containerField='value' name='visits'>
          <MetadataSet containerField='value' name='turning'>
            <MetadataString containerField='value' name='activity' value='"turn"'/>
            <MetadataSet containerField='value' name='move:1'>
              <MetadataString containerField='value' name='kind' value='"reach"'/>
              <MetadataString containerField='value' name='body' value='"WHEEL"'/>
              <MetadataDouble containerField='value' name='grip' value='0 0.3 0'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='move:2'>
              <MetadataString containerField='value' name='kind' value='"grasp"'/>
              <MetadataString containerField='value' name='body' value='"WHEEL"'/>
            </MetadataSet>
            <MetadataSet containerField='value' name='move:3'>
              <MetadataString containerField='value' name='kind' value='"turn"'/>
              <MetadataString containerField='value' name='joint' value='"AXLE"'/>
              <MetadataDouble containerField='value' name='turns' value='1.2'/>
            </MetadataSet>
          </MetadataSet>
        </MetadataSet>
      </MetadataSet>
    </WorldInfo>
    <Viewpoint description='front' position='0 1 2.5'/>
    <Inline DEF='MODEL' url='"wheel.glb"'/>
    <RigidBodyCollection gravity='0 -9.81 0'>
      <RigidBody DEF='POST' fixed='true'>
        <MetadataSet containerField='metadata' name='mechane:body'>
          <MetadataString containerField='value' name='model' value='"MODEL"'/>
        </MetadataSet>
      </RigidBody>
      <RigidBody DEF='WHEEL' mass='2' inertia='0.05 0 0 0 0.05 0 0 0 0.09' position='0 1 0.1'>
        <MetadataSet containerField='metadata' name='mechane'>
          <MetadataSet containerField='value' name='mechane:body'>
            <MetadataString containerField='value' name='model' value='"MODEL"'/>
          </MetadataSet>
          <MetadataSet containerField='value' name='mechane:haptic'>
            <MetadataBoolean containerField='value' name='graspable' value='true'/>
          </MetadataSet>
        </MetadataSet>
      </RigidBody>
      <SingleAxisHingeJoint DEF='AXLE' anchorPoint='0 1 0.1' axis='0 0 1'>
        <MetadataSet containerField='metadata' name='mechane:agent'>
          <MetadataString containerField='value' name='type' value='"geometry.hinge"'/>
        </MetadataSet>
        <RigidBody containerField='body1' USE='POST'/>
        <RigidBody containerField='body2' USE='WHEEL'/>
      </SingleAxisHingeJoint>
    </RigidBodyCollection>
  </Scene>
</X3D>
)";

using Piece = Variation::Piece;

constexpr Piece kStepPieces[] = {
    {"In `quantities`, two more; one is a set, because it has a unit", "quantities",
     R"(<MetadataString containerField='value' name='hands' value='"HOLD.active"'/>
<MetadataSet containerField='value' name='speed'>
  <MetadataString containerField='value' name='source' value='"AXLE.rate"'/>
  <MetadataString containerField='value' name='unit' value='"rpm"'/>
</MetadataSet>
)"},
    {"In the step `once`, its trigger leads on", "",
     R"(                  <MetadataString containerField='value' name='next' value='"run-out"'/>
)",
     R"(                  <MetadataString containerField='value' name='next' value='"end"'/>
)"},
    {"In the `text` of `once`, what is read aloud, and a hint for visitors who do not get on", "once/text",
     R"(<MetadataString containerField='value' name='narration.en' value='"The spokes are of ash, the tyre is of iron."'/>
<MetadataString containerField='value' name='hint.en' value='"Bring your hand to the rim, and close it."'/>
)"},
    {"In `once`, after how long that is", "once",
     R"(<MetadataDouble containerField='value' name='hintSeconds' value='15'/>
)"},
    {"In `steps`, the step that follows. Both rules must hold for a second; after half a minute it ends in "
     "any case",
     "steps",
     R"(<MetadataSet containerField='value' name='run-out'>
  <MetadataSet containerField='value' name='text'>
    <MetadataString containerField='value' name='caption.en' value='"Let go, and see how long the wheel runs."'/>
  </MetadataSet>
  <MetadataString containerField='value' name='detail' value='"HUB_VIEW"'/>
  <MetadataSet containerField='value' name='trigger:1'>
    <MetadataSet containerField='value' name='rule:1'>
      <MetadataString containerField='value' name='quantity' value='"speed"'/>
      <MetadataString containerField='value' name='op' value='"&lt;"'/>
      <MetadataDouble containerField='value' name='value' value='2'/>
    </MetadataSet>
    <MetadataSet containerField='value' name='rule:2'>
      <MetadataString containerField='value' name='quantity' value='"hands"'/>
      <MetadataString containerField='value' name='op' value='"="'/>
      <MetadataDouble containerField='value' name='value' value='0'/>
    </MetadataSet>
    <MetadataString containerField='value' name='match' value='"all"'/>
    <MetadataDouble containerField='value' name='holdSeconds' value='1'/>
    <MetadataString containerField='value' name='next' value='"show"'/>
  </MetadataSet>
  <MetadataDouble containerField='value' name='timeoutSeconds' value='30'/>
  <MetadataString containerField='value' name='timeoutNext' value='"show"'/>
</MetadataSet>
)"},
    {"And a last one, in which the wheel is back at its place, and nobody can take it. HOLD is off", "steps",
     R"(<MetadataSet containerField='value' name='show'>
  <MetadataString containerField='value' name='disable' value='"HOLD"'/>
  <MetadataSet containerField='value' name='object:WHEEL'>
    <MetadataBoolean containerField='value' name='graspable' value='false'/>
    <MetadataDouble containerField='value' name='position' value='0 1 0.1'/>
  </MetadataSet>
  <MetadataSet containerField='value' name='text'>
    <MetadataString containerField='value' name='caption.en' value='"So light is a wheel on a greased axle."'/>
  </MetadataSet>
  <MetadataDouble containerField='value' name='timeoutSeconds' value='5'/>
</MetadataSet>
)"},
    {"Under the Scene, from where the close-up of `run-out` is seen", "",
     R"(    <Viewpoint description='front' position='0 1 2.5'/>
    <Viewpoint DEF='HUB_VIEW' description='hub' position='0.2 1.1 0.6' orientation='-0.6 0.77 0.2 0.4'/>
)",
     R"(    <Viewpoint description='front' position='0 1 2.5'/>
)"},
};

constexpr Piece kSurfacePieces[] = {
    {"In `agents`, how the wheel feels then; what is not written is as its `mechane:haptic` has it", "agents",
     R"(<MetadataSet containerField='value' name='OILED'>
  <MetadataString containerField='value' name='type' value='"touch.surface"'/>
  <MetadataString containerField='value' name='object' value='"WHEEL"'/>
  <MetadataDouble containerField='value' name='staticFriction' value='0.1'/>
  <MetadataDouble containerField='value' name='dynamicFriction' value='0.05'/>
  <MetadataDouble containerField='value' name='viscosity' value='1'/>
</MetadataSet>
)"},
    {"In the step `once`, its trigger leads on", "",
     R"(                  <MetadataString containerField='value' name='next' value='"oil"'/>
)",
     R"(                  <MetadataString containerField='value' name='next' value='"end"'/>
)"},
    {"In `steps`, the step that switches it on", "steps",
     R"(<MetadataSet containerField='value' name='oil'>
  <MetadataString containerField='value' name='enable' value='"OILED"'/>
  <MetadataSet containerField='value' name='text'>
    <MetadataString containerField='value' name='caption.en' value='"The rim has been oiled. Lift your hand off, and stroke it."'/>
  </MetadataSet>
  <MetadataDouble containerField='value' name='timeoutSeconds' value='20'/>
</MetadataSet>
)"},
};

constexpr Piece kPullPieces[] = {
    {"In the RigidBodyCollection, in place of the post: the post, on whose foot things can lie, and the pin", "",
     R"(      <RigidBody DEF='POST' fixed='true'>
        <MetadataSet containerField='metadata' name='mechane:body'>
          <MetadataString containerField='value' name='model' value='"MODEL"'/>
          <MetadataBoolean containerField='value' name='collides' value='true'/>
        </MetadataSet>
      </RigidBody>
      <RigidBody DEF='PIN' mass='0.1' inertia='1e-5 0 0 0 1e-5 0 0 0 1e-5' position='0.2 0.05 0.1'>
        <MetadataSet containerField='metadata' name='mechane'>
          <MetadataSet containerField='value' name='mechane:body'>
            <MetadataString containerField='value' name='model' value='"MODEL"'/>
            <MetadataBoolean containerField='value' name='collides' value='true'/>
          </MetadataSet>
          <MetadataSet containerField='value' name='mechane:haptic'>
            <MetadataBoolean containerField='value' name='graspable' value='true'/>
          </MetadataSet>
        </MetadataSet>
      </RigidBody>
)",
     R"(      <RigidBody DEF='POST' fixed='true'>
        <MetadataSet containerField='metadata' name='mechane:body'>
          <MetadataString containerField='value' name='model' value='"MODEL"'/>
        </MetadataSet>
      </RigidBody>
)"},
    {"In `agents`, what HOLD takes", "",
     R"(            <MetadataString containerField='value' name='bodies' value='"WHEEL" "PIN"'/>
)",
     R"(            <MetadataString containerField='value' name='bodies' value='"WHEEL"'/>
)"},
    {"And the place: before the hub, the pin's z axis straight out, however it is turned about it", "agents",
     R"(<MetadataSet containerField='value' name='BEFORE_HUB'>
  <MetadataString containerField='value' name='type' value='"geometry.snap"'/>
  <MetadataString containerField='value' name='object' value='"PIN"'/>
  <MetadataString containerField='value' name='into' value='"POST"'/>
  <MetadataDouble containerField='value' name='position' value='0 1 0.15'/>
  <MetadataDouble containerField='value' name='tolerance' value='0.02 0.5'/>
  <MetadataDouble containerField='value' name='axis' value='0 0 1'/>
  <MetadataDouble containerField='value' name='pull' value='0.8'/>
  <MetadataDouble containerField='value' name='pullFrom' value='0.2'/>
</MetadataSet>
)"},
    {"In `quantities`, whether it is there", "quantities",
     R"(<MetadataString containerField='value' name='secured' value='"BEFORE_HUB.placed"'/>
)"},
    {"In the step `once`, its trigger leads on", "",
     R"(                  <MetadataString containerField='value' name='next' value='"secure"'/>
)",
     R"(                  <MetadataString containerField='value' name='next' value='"end"'/>
)"},
    {"In `steps`, the step that waits for it", "steps",
     R"(<MetadataSet containerField='value' name='secure'>
  <MetadataSet containerField='value' name='text'>
    <MetadataString containerField='value' name='caption.en' value='"Take the pin to the hub. You feel how it is drawn there."'/>
  </MetadataSet>
  <MetadataSet containerField='value' name='trigger:1'>
    <MetadataString containerField='value' name='quantity' value='"secured"'/>
    <MetadataString containerField='value' name='op' value='">"'/>
    <MetadataDouble containerField='value' name='value' value='0.5'/>
  </MetadataSet>
</MetadataSet>
)"},
};

constexpr Piece kQuestionPieces[] = {
    {"In the activity `turn`, beside its `steps`", "activities/turn",
     R"(<MetadataSet containerField='value' name='questionnaire'>
  <MetadataSet containerField='value' name='why'>
    <MetadataString containerField='value' name='kind' value='"choice"'/>
    <MetadataString containerField='value' name='answers' value='"grease" "weight"'/>
    <MetadataString containerField='value' name='correct' value='"grease"'/>
    <MetadataSet containerField='value' name='text'>
      <MetadataString containerField='value' name='question.en' value='"Why does it turn so easily?"'/>
      <MetadataString containerField='value' name='answer:grease.en' value='"The axle is greased"'/>
      <MetadataString containerField='value' name='answer:weight.en' value='"The wheel weighs little"'/>
    </MetadataSet>
  </MetadataSet>
  <MetadataSet containerField='value' name='liked'>
    <MetadataString containerField='value' name='kind' value='"scale"'/>
    <MetadataDouble containerField='value' name='steps' value='5'/>
    <MetadataSet containerField='value' name='text'>
      <MetadataString containerField='value' name='question.en' value='"Did you enjoy it?"'/>
      <MetadataString containerField='value' name='low.en' value='"a little"'/>
      <MetadataString containerField='value' name='high.en' value='"very much"'/>
    </MetadataSet>
  </MetadataSet>
</MetadataSet>
)"},
};

constexpr Piece kMachinePieces[] = {
    {"In `mechane:scenario`, beside `agents`", "mechane:scenario",
     R"(<MetadataSet containerField='value' name='machines'>
  <MetadataSet containerField='value' name='SCREW'>
    <MetadataString containerField='value' name='type' value='"machine.screw_pump"'/>
    <MetadataString containerField='value' name='joint' value='"AXLE"'/>
    <MetadataDouble containerField='value' name='diameter' value='0.2'/>
    <MetadataDouble containerField='value' name='length' value='1'/>
    <MetadataDouble containerField='value' name='lift' value='0.5'/>
    <MetadataDouble containerField='value' name='basinArea' value='0.1'/>
    <MetadataDouble containerField='value' name='basinCapacity' value='20'/>
  </MetadataSet>
</MetadataSet>
)"},
    {"In `quantities`, what drives the effects; a flow and a height need their units", "quantities",
     R"(<MetadataSet containerField='value' name='flow'>
  <MetadataString containerField='value' name='source' value='"SCREW.flow_l_per_s"'/>
  <MetadataString containerField='value' name='unit' value='"l/s"'/>
</MetadataSet>
<MetadataSet containerField='value' name='water'>
  <MetadataString containerField='value' name='source' value='"SCREW.level_m"'/>
  <MetadataString containerField='value' name='unit' value='"m"'/>
</MetadataSet>
<MetadataSet containerField='value' name='speed'>
  <MetadataString containerField='value' name='source' value='"AXLE.rate"'/>
  <MetadataString containerField='value' name='unit' value='"rpm"'/>
</MetadataSet>
)"},
    {"In `mechane:scenario`: water runs from a spout on the post, it rises in the tub, and the wheel creaks, loudest "
     "at 40 turns a minute",
     "mechane:scenario",
     R"(<MetadataSet containerField='value' name='effects'>
  <MetadataSet containerField='value' name='SPOUT'>
    <MetadataString containerField='value' name='kind' value='"stream"'/>
    <MetadataString containerField='value' name='quantity' value='"flow"'/>
    <MetadataString containerField='value' name='body' value='"POST"'/>
    <MetadataDouble containerField='value' name='point' value='0.1 0.6 0.05'/>
    <MetadataDouble containerField='value' name='direction' value='1 0 0'/>
    <MetadataDouble containerField='value' name='speed' value='0.5'/>
  </MetadataSet>
  <MetadataSet containerField='value' name='TUB'>
    <MetadataString containerField='value' name='kind' value='"level"'/>
    <MetadataString containerField='value' name='quantity' value='"water"'/>
    <MetadataString containerField='value' name='node' value='"WATER_TUB"'/>
  </MetadataSet>
  <MetadataSet containerField='value' name='CREAK'>
    <MetadataString containerField='value' name='kind' value='"sound.wood"'/>
    <MetadataString containerField='value' name='quantity' value='"speed"'/>
    <MetadataString containerField='value' name='body' value='"WHEEL"'/>
    <MetadataDouble containerField='value' name='full' value='40'/>
  </MetadataSet>
</MetadataSet>
)"},
};

constexpr Piece kFormulaPieces[] = {
    {"In `mechane:scenario`, beside `agents`", "mechane:scenario",
     R"XML(<MetadataSet containerField='value' name='machines'>
  <MetadataSet containerField='value' name='SPRING'>
    <MetadataString containerField='value' name='type' value='"machine.formula"'/>
    <MetadataString containerField='value' name='values' value='
      "pull = 0.4 N m/rad * clamp(AXLE.angle, 0 rad, 2 turns) in N m"
      "wound = integral(abs(AXLE.rate), 0 rad, 0 rad, 99 turns) in turns"
      "visits = count(AXLE.angle > 0.5 turns) in 1"'/>
    <MetadataString containerField='value' name='joint' value='"AXLE"'/>
    <MetadataString containerField='value' name='load' value='"-pull"'/>
    <MetadataString containerField='value' name='resistance' value='"0.05 N m s/rad * abs(AXLE.rate)"'/>
  </MetadataSet>
</MetadataSet>
)XML"},
    {"In `quantities`, names for two of its values", "quantities",
     R"(<MetadataSet containerField='value' name='pull'>
  <MetadataString containerField='value' name='source' value='"SPRING.pull"'/>
  <MetadataString containerField='value' name='unit' value='"N m"'/>
</MetadataSet>
<MetadataString containerField='value' name='visits' value='"SPRING.visits"'/>
)"},
};

constexpr Piece kWaterPieces[] = {
    {"In `mechane:scenario`, beside `agents`", "mechane:scenario",
     R"XML(<MetadataSet containerField='value' name='machines'>
  <MetadataSet containerField='value' name='WATER'>
    <MetadataString containerField='value' name='type' value='"machine.water_network"'/>
    <MetadataString containerField='value' name='vessels' value='
      "TANK: area 0.03 m2, height 40 cm, floor 1.2 m, start 12 l"
      "CUP: area pi * (6 cm)^2, height 20 cm, floor 0.3 m"'/>
    <MetadataString containerField='value' name='pipes' value='
      "SPOUT: from TANK at 1.2 m, to CUP, bore 6 mm, discharge 0.8, open AXLE.angle / 1 turns"
      "SIPHON: from CUP at 31 cm, to air at 10 cm, bore 12 mm, crest 45 cm"'/>
    <MetadataString containerField='value' name='feeds' value='"SPRING: into TANK, flow 6 l/min"'/>
  </MetadataSet>
</MetadataSet>
)XML"},
    {"In `quantities`, names for two of its values", "quantities",
     R"(<MetadataSet containerField='value' name='water'>
  <MetadataString containerField='value' name='source' value='"WATER.CUP_level"'/>
  <MetadataString containerField='value' name='unit' value='"m"'/>
</MetadataSet>
<MetadataSet containerField='value' name='siphon'>
  <MetadataString containerField='value' name='source' value='"WATER.SIPHON_flow"'/>
  <MetadataString containerField='value' name='unit' value='"l/s"'/>
</MetadataSet>
)"},
};

constexpr Piece kLanguagePieces[] = {
    {"In `mechane:scenario`, in place of the line that names them; the first is shown first", "",
     R"(        <MetadataString containerField='value' name='languages' value='"el" "en"'/>
)",
     R"(        <MetadataString containerField='value' name='languages' value='"en"'/>
)"},
    {"In the scenario's `text`", "mechane:scenario/text",
     R"(<MetadataString containerField='value' name='title.el' value='"Ο τροχός"'/>
)"},
    {"In the `text` of `turn`", "activities/turn/text",
     R"(<MetadataString containerField='value' name='title.el' value='"Γυρίστε τον τροχό"'/>
<MetadataString containerField='value' name='goal.el' value='"Ένας τροχός γυρίζει εύκολα γύρω από τον άξονά του."'/>
)"},
    {"In the `text` of `once`", "once/text",
     R"(<MetadataString containerField='value' name='caption.el' value='"Πιάστε το στεφάνι και γυρίστε τον τροχό μία φορά."'/>
)"},
};

constexpr Piece kSignPieces[] = {
    {"In `agents`, the agent that sees the finger", "agents", R"(<MetadataSet containerField='value' name='POINT'>
  <MetadataString containerField='value' name='type' value='"simulation.point"'/>
  <MetadataString containerField='value' name='body' value='"POST"'/>
</MetadataSet>
)"},
    {"In `quantities`, a name for what it sees", "quantities",
     R"(<MetadataString containerField='value' name='at_sign' value='"POINT.pointed"'/>
)"},
    {"In the step `once`, what leads away from it", "once", R"(<MetadataSet containerField='value' name='trigger:2'>
  <MetadataString containerField='value' name='quantity' value='"at_sign"'/>
  <MetadataString containerField='value' name='op' value='">"'/>
  <MetadataDouble containerField='value' name='value' value='0.5'/>
  <MetadataString containerField='value' name='next' value='"to-screw"'/>
</MetadataSet>
)"},
    {"In `steps`, the step that opens the other by its `id`; where the server has no such scenario, the visitor is "
     "soon "
     "back",
     "steps", R"(<MetadataSet containerField='value' name='to-screw'>
  <MetadataString containerField='value' name='opens' value='"archimedes-screw"'/>
  <MetadataSet containerField='value' name='text'>
    <MetadataString containerField='value' name='caption.en' value='"To the screw ..."'/>
  </MetadataSet>
  <MetadataDouble containerField='value' name='timeoutSeconds' value='6'/>
  <MetadataString containerField='value' name='timeoutNext' value='"once"'/>
</MetadataSet>
)"},
};

constexpr Piece kCopyPieces[] = {
    {"In the RigidBodyCollection, in place of the post: the post, and a pile of coins to look at. The mesh file has "
     "one node "
     "more, `COIN`",
     "", R"(      <RigidBody DEF='POST' fixed='true'>
        <MetadataSet containerField='metadata' name='mechane:body'>
          <MetadataString containerField='value' name='model' value='"MODEL"'/>
        </MetadataSet>
      </RigidBody>
      <RigidBody DEF='COIN' fixed='true' position='0.4 0.8 0'>
        <MetadataSet containerField='metadata' name='mechane:body'>
          <MetadataString containerField='value' name='model' value='"MODEL"'/>
          <MetadataSet containerField='value' name='copies'>
            <MetadataDouble containerField='value' name='count' value='20'/>
            <MetadataDouble containerField='value' name='step' value='0 0.003 0'/>
          </MetadataSet>
        </MetadataSet>
      </RigidBody>
)",
     R"(      <RigidBody DEF='POST' fixed='true'>
        <MetadataSet containerField='metadata' name='mechane:body'>
          <MetadataString containerField='value' name='model' value='"MODEL"'/>
        </MetadataSet>
      </RigidBody>
)"},
};

constexpr Variation kVariations[] = {
    {"More steps", "To the example come two steps, a hint, words that are read aloud, and a close-up.", kStepPieces},
    {"A surface that changes with the step",
     "From a step that enables such an agent on, a body feels otherwise, until a step disables it or the activity\n"
     "begins anew; where no step enables it, it is on from the beginning. A hand that touches the body goes on "
     "feeling\n"
     "what it met, until it leaves: let the caption ask for that. Every key of `mechane:haptic` that makes a surface\n"
     "can change: how hard it is, its friction, its grooves, its knock. The wet end of a rope and the dry one are two\n"
     "bodies: a surface is that of a whole body.",
     kSurfacePieces},
    {"A place that pulls",
     "A snap takes a body once it is close. With `pull` its place draws the body from further away, and the hand that\n"
     "carries it feels where it belongs: softly at `pullFrom`, most at 0.45 of that, not at all in the place. Some\n"
     "0.5 to 2 N are felt well. More than the `forceLimit` of the grasp (12 N where it is not written) would tear the\n"
     "body away, and what feels very light (mass times `effortScale`) bears less: `mechane check` says how much. A\n"
     "hand feels the pull on its way in only as far as it has lifted the body. Only a step in which a hand can carry\n"
     "the body while the snap is on has a pull. In the example, a pin lies on the foot of the post. The mesh file has\n"
     "one node more, `PIN`.",
     kPullPieces},
    {"Questions",
     "They are asked when the activity is done (a display may also ask them before), and counted by `mechane visits`.",
     kQuestionPieces},
    {"A machine, and what is seen and heard of it",
     "Let the axle turn a small screw that lifts water into a tub. The mesh file has one node more, `WATER_TUB`.",
     kMachinePieces},
    {"A machine of your own",
     "Where no machine in the list below does what yours does, write its formulas: see *Formulas* near the end. Here "
     "a spring\nin the hub pulls the wheel back, for two turns at most, grease brakes it, and what it has done can be "
     "shown.",
     kFormulaPieces},
    {"A network of water",
     "Vessels, and what leads from one to the other: see *Water networks* near the end. Here the wheel is the tap of a "
     "tank,\nquite open after one turn. The cup below fills until its siphon runs, and this empties it at once: the "
     "cup of "
     "Tantalus.",
     kWaterPieces},
    {"Many bodies of one",
     "Twenty coins need not be written twenty times: a `RigidBody` whose `mechane:body` has a set `copies` stands for\n"
     "many bodies.\n"
     "\n"
     "- They are called COIN-1 to COIN-20; no body is called COIN alone. They have all that COIN has (shape, mass, "
     "feel, title), and differ in\n"
     "  name and place. COIN-1 stands where COIN is written, unless a list of `positions` says otherwise.\n"
     "- They stand in **a row** or a pile (`count` and `step`), in **a grid** (also `columns` and `rowStep`), in **a "
     "ring** (`count` and\n"
     "  `ringCentre`), or as `positions` **lists** them. No two may stand at the same place.\n"
     "- Agents, machines, quantities, effects, visits and steps name one of them, as any body: `\"COIN-3\"`, "
     "`\"COIN-3.speed\"`, `object:COIN-3`.\n"
     "  Where several bodies may be named, `\"COIN-*\"` is all; and `object:COIN-*` in a step changes all, but for "
     "their places.\n"
     "- A joint, a `ROUTE` and a `mechane:agent` on the body itself cannot tell one from another: such a body is a "
     "RigidBody of its own.\n"
     "- Why a key, and not X3D's own means? `USE` is the same body once more, not another one; a prototype would do, "
     "but each of its instances\n"
     "  has to be written, too. To other X3D programs the file has one coin.",
     kCopyPieces},
    {"Another language", "Each text is written once for each language; `mechane check` names the missing ones.",
     kLanguagePieces},
    {"A sign to another exhibit",
     "A finger on a body, or a click on it, lets the kiosk go on to another scenario of the server. To make the post "
     "of "
     "the example such a sign:",
     kSignPieces},
};

/// Where the last line of the set at `path` begins. In the example the end tag of a set is indented like its start tag.
std::size_t end_of_set(const std::string& file, std::string_view path) {
  std::size_t at = 0;
  std::string indent;
  while (!path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    at = file.find("name='" + std::string(path.substr(0, slash)) + "'>", at);
    MECHANE_ASSERT(at != std::string::npos);
    const std::size_t line = file.rfind('\n', at) + 1;
    indent = file.substr(line, file.find('<', line) - line);
    path.remove_prefix(std::min(slash + 1, path.size()));
  }
  const std::size_t end = file.find("\n" + indent + "</MetadataSet>", at);
  MECHANE_ASSERT(end != std::string::npos);
  return end + 1;
}

}  // namespace

std::string_view reference_shapes() {
  return kShapes;
}

std::string reference_example() {
  return std::string(kExample);
}

std::span<const Variation> reference_variations() {
  return kVariations;
}

std::string reference_example_with(const Variation& variation) {
  std::string file(kExample);
  for (const Piece& piece : variation.pieces) {
    if (piece.instead.empty()) {
      file.insert(end_of_set(file, piece.into), piece.text);
    } else {
      const std::size_t at = file.find(piece.instead);
      MECHANE_ASSERT(at != std::string::npos);
      file.replace(at, piece.instead.size(), piece.text);
    }
  }
  return file;
}

}  // namespace mechane::authoring
