/* The interface between Mechane and the driver of a haptic device or a glove. A driver is a shared object, mechane_driver_NAME.so, that
 * exports mechane_driver(). It may be written in any language that can export C functions, and needs no other file of Mechane.
 *
 * All numbers are SI: m, rad, N, N m, s. The frame D is right-handed with its origin in the middle of the workspace, x to the visitor's
 * right, y up, z towards the visitor. A driver converts units and axes; nobody else does.
 *
 * A driver runs in a process of its own, on one thread. Its functions are called in this order: open(), describe(), then read() and
 * write() in turn, rate_hz times a second, and close(). Mechane waits between two rounds, unless the device sets the pace (paces). After a
 * failed read() or write() the device is closed, and opened again a second later. A crash, or a call of read() or write() that takes two
 * seconds, ends the whole program; open() may take 30 s, and close() two. No function may throw or change the process's signals or locale.
 *
 * Mechane limits each force to what describe() stated before it reaches write(), writes zero when it has heard nothing from the haptic loop
 * for 20 ms, and writes zero before close(). What happens when the driver's own process is killed is up to the device: one that holds its
 * last command needs a watchdog of its own. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Drivers of version 1 are loaded too; what is marked with 2 is not asked of them. */
#define MECHANE_DRIVER_VERSION 2u
#define MECHANE_FINGERS 5      /* thumb, index, middle, ring, little */
#define MECHANE_HAND_JOINTS 20 /* by finger: abduction, towards the thumb; then three flexions from the palm outwards */

/* What a device can do to a hand. */
typedef enum mechane_output {
  MECHANE_OUTPUT_NONE = 0,        /* it only reads the hand */
  MECHANE_OUTPUT_FORCE = 1,       /* a force at tip or wrist, and a torque where peak_torque_nm is over 0 */
  MECHANE_OUTPUT_FINGER_PULL = 2, /* a force on each finger that opens it, never closes it */
  MECHANE_OUTPUT_FINGER_BRAKE =
      3 /* a finger is held from closing further while finger_n of it is over 0; it may always open */
} mechane_output;

typedef enum mechane_hand_kind {
  MECHANE_HAND_POINT = 0, /* one point: a stylus, a knob */
  MECHANE_HAND_GLOVE = 1  /* a hand with joints */
} mechane_hand_kind;

/* Which hand it is on. Angles mean the same on both: a left hand has those of the right hand that is its mirror image. */
typedef enum mechane_hand_side { MECHANE_HAND_RIGHT = 0, MECHANE_HAND_LEFT = 1 } mechane_hand_side;

/* What the device is and can bear. Does not change while it is open. It comes filled with zeros, as the state below does. */
typedef struct mechane_device_info {
  char name[64];                /* for people: maker and model, UTF-8, ends with a 0 */
  uint32_t hand;                /* mechane_hand_kind */
  uint32_t output;              /* mechane_output */
  double peak_force_n;          /* for a moment; 0 .. 100 */
  double continuous_force_n;    /* all day; 0 .. peak_force_n */
  double peak_torque_nm;        /* 0: none; 0 .. 10 */
  double peak_finger_force_n;   /* of FINGER_PULL; 0 .. 40 */
  double max_stiffness_n_per_m; /* that it renders without shaking; 0: not known */
  double max_damping_ns_per_m;  /* 0: not known */
  double rate_hz;               /* how often it wants to be served; 50 .. 8000 */
  double workspace_min_m[3];    /* in D; both all 0: not known */
  double workspace_max_m[3];
  uint32_t paces; /* 1: read() waits for the device's next sample, 0.1 s at most, and so sets the pace */
  uint32_t side;  /* 2: mechane_hand_side, of a glove */
} mechane_device_info;

/* Bits of mechane_device_state.flags. */
enum {
  MECHANE_STATE_READY = 1u,    /* calibrated, powered, and held, where the device can tell: it may render a force */
  MECHANE_STATE_HOT = 2u,      /* its motors are too warm for any force */
  MECHANE_STATE_DEAD_MAN = 4u, /* its dead-man's switch is released, or it lies in its holder */
  MECHANE_STATE_UNCALIBRATED =
      8u /* somebody has to calibrate it. Renders nothing; this and the two before tell visitors why */
};

/* The hand now. */
typedef struct mechane_device_state {
  uint32_t flags;
  uint32_t buttons;           /* bit 0: the first */
  double position_m[3];       /* of the tip or the wrist in D; 0 for a glove without a tracker */
  double orientation_wxyz[4]; /* unit quaternion, from the hand's frame to D; 1 0 0 0 where the device has none */
  double joints_rad[MECHANE_HAND_JOINTS]; /* of a glove; flexions grow as the hand closes */
  double grasp;                           /* 0 open .. 1 closed */
  double temperature;                     /* of the motors: 0 cold .. 1 too hot; below 0: not known */
  /* 2: sizes of the visitor's hand, where the device measures them; 0: not known. They may become known, and better, while it is read. */
  double palm_m; /* from the wrist to the middle between the first joints of index and little finger; 0.02 .. 0.25 */
  double finger_m[MECHANE_FINGERS]; /* from its first joint along the bones to the last one's tip; 0.005 .. 0.5 */
} mechane_device_state;

/* What to render until the next call. */
typedef struct mechane_device_force {
  double force_n[3]; /* on the hand, in D */
  double torque_nm[3];
  double finger_n[MECHANE_FINGERS]; /* each at least 0 */
} mechane_device_force;

/* A driver. Functions that return a number return 0, or another number when they failed; `why` then says what happened and what to do
 * about it: one line of UTF-8 that ends with a 0, of at most why_size bytes. */
typedef struct mechane_driver_table {
  uint32_t version;    /* MECHANE_DRIVER_VERSION */
  const char* summary; /* for people, one line: which devices */
  const char* options; /* for people: what open() understands, as in "port=/dev/ttyUSB0"; "" for nothing */

  /* `options` is what stands behind the name in --device NAME:OPTIONS, or "". The device renders no force
   * until the first write(). *device must not stay NULL. */
  int (*open)(const char* options, void** device, char* why, size_t why_size);
  int (*describe)(void* device, mechane_device_info* info, char* why, size_t why_size);
  /* Fails when the device is gone or faulty. */
  int (*read)(void* device, mechane_device_state* state, char* why, size_t why_size);
  int (*write)(void* device, const mechane_device_force* force, char* why, size_t why_size);
  void (*close)(void* device);
} mechane_driver_table;

/* The one function that a driver exports. Returns a table that lives as long as the library, or NULL when the driver does not know this
 * version of the interface. */
__attribute__((visibility("default"))) const mechane_driver_table* mechane_driver(uint32_t version);

#ifdef __cplusplus
}
#endif
