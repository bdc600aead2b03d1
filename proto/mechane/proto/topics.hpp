// The typed topics: each wire type with its name, its descriptor and its QoS. The fields are described in idl/mechane.idl.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <mechane.h>

#include <mechane/proto/qos.hpp>

namespace mechane::proto {

/// Version of idl/mechane.idl. Raise it when a message has another field, a field another meaning, or CommandKind another kind. A new
/// topic needs no new version: programs that do not know it do not subscribe to it. Receivers drop samples of another version.
inline constexpr std::uint32_t kProtocol = 11;

using HapticInput = ::mechane_HapticInput;
using HapticOutput = ::mechane_HapticOutput;
using SceneFrame = ::mechane_SceneFrame;
using SceneObject = ::mechane_SceneObject;
using WorldStatus = ::mechane_WorldStatus;
using WorldPresentation = ::mechane_WorldPresentation;
using Event = ::mechane_Event;
using Command = ::mechane_Command;
using CommandKind = ::mechane_CommandKind;
using WorldAssignment = ::mechane_WorldAssignment;
using ServerStatus = ::mechane_ServerStatus;
using KioskStatus = ::mechane_KioskStatus;
using DeviceStatus = ::mechane_DeviceStatus;
using DeviceRequest = ::mechane_DeviceRequest;
using DisplayStatus = ::mechane_DisplayStatus;
using DisplayRequest = ::mechane_DisplayRequest;
using ViewerHead = ::mechane_ViewerHead;
using ExhibitStatus = ::mechane_ExhibitStatus;
using ExhibitRequest = ::mechane_ExhibitRequest;
using WirePose = ::mechane_Pose;
using WireLocalContact = ::mechane_LocalContact;
using WireHeldPath = ::mechane_HeldPath;
using WireDevicePlace = ::mechane_DevicePlace;
using WireBodyPose = ::mechane_BodyPose;
using WireHandPose = ::mechane_HandPose;
using WireText = ::mechane_Text;
using WireQuantity = ::mechane_Quantity;
using WireQuantityGoal = ::mechane_QuantityGoal;
using WireRope = ::mechane_RopeShape;
using WireAnswer = ::mechane_Answer;
using WireQuestion = ::mechane_Question;
using WireActivity = ::mechane_Activity;
using WireView = ::mechane_View;
using WireEffect = ::mechane_Effect;
using WireAffordance = ::mechane_Affordance;
using HandOwner = ::mechane_HandOwner;
using WireSetting = ::mechane_DisplaySetting;
using WireRequestAnswer = ::mechane_RequestAnswer;
using WireExhibit = ::mechane_OpenableExhibit;
using WireExhibitAnswer = ::mechane_ExhibitAnswer;

/// Where a topic's endpoints live.
enum class Place { museum, kiosk, world };

/// Specialised for each topic.
template <class T>
struct TopicOf;

// clang-format off
#define MECHANE_PROTO_TOPIC(Type, its_place, its_qos)                                        \
  template <>                                                                                \
  struct TopicOf<Type> {                                                                     \
    static constexpr const char* name = #Type;                                               \
    static constexpr const dds_topic_descriptor_t* descriptor = &::mechane_##Type##_desc;    \
    static constexpr Place place = Place::its_place;                                         \
    static Qos qos() { return its_qos(); }                                                   \
  }
MECHANE_PROTO_TOPIC(HapticInput, kiosk, haptic_input_qos);
MECHANE_PROTO_TOPIC(HapticOutput, kiosk, haptic_output_qos);
MECHANE_PROTO_TOPIC(SceneFrame, world, scene_frame_qos);
MECHANE_PROTO_TOPIC(SceneObject, world, scene_object_qos);
MECHANE_PROTO_TOPIC(WorldStatus, world, world_status_qos);
MECHANE_PROTO_TOPIC(WorldPresentation, world, world_status_qos);
MECHANE_PROTO_TOPIC(Event, world, event_qos);
MECHANE_PROTO_TOPIC(Command, world, command_qos);
MECHANE_PROTO_TOPIC(WorldAssignment, museum, world_assignment_qos);
MECHANE_PROTO_TOPIC(ServerStatus, museum, server_status_qos);
MECHANE_PROTO_TOPIC(KioskStatus, museum, kiosk_status_qos);
MECHANE_PROTO_TOPIC(DeviceStatus, museum, kiosk_status_qos);
MECHANE_PROTO_TOPIC(DeviceRequest, museum, command_qos);
MECHANE_PROTO_TOPIC(DisplayStatus, museum, display_status_qos);
MECHANE_PROTO_TOPIC(DisplayRequest, museum, command_qos);
MECHANE_PROTO_TOPIC(ViewerHead, museum, viewer_head_qos);
MECHANE_PROTO_TOPIC(ExhibitStatus, museum, exhibit_status_qos);
MECHANE_PROTO_TOPIC(ExhibitRequest, museum, command_qos);
#undef MECHANE_PROTO_TOPIC
// clang-format on

/// A type of idl/mechane.idl that has a topic.
template <class T>
concept TopicType = requires {
  TopicOf<T>::descriptor;
};

/// Samples of these types have no pointers: they are read into the caller's storage and may be copied.
template <class T>
concept FixedSize = std::is_same_v<T, HapticInput> || std::is_same_v<T, HapticOutput> || std::is_same_v<T, KioskStatus>;

}  // namespace mechane::proto
