/* What the driver of the CyberGrasp wants of the maker's VirtualHand SDK. The SDK may not be shipped and is C++ of
 * its own compiler, so a museum that owns it builds a small shared library with the functions below, and gives it to
 * the driver as library=FILE. This header is all that the library needs of Mechane.
 *
 * One glove is open at a time. All calls come from one thread, and each should return within 10 ms, but for open,
 * which may take 20 s; after 0.1 s the driver takes the glove for lost. No function may throw. Those that return a
 * number return 0, or another number when they failed, except where something else stands there;
 * mechane_grasp_error() then says why. In brackets is what of the SDK does it, as far as is published
 * (vhtCyberGrasp.h 1.22). */
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define MECHANE_GRASP_VERSION 1
#define MECHANE_GRASP_EXPORT __attribute__((visibility("default")))

/* The controller's modes, with the SDK's numbers; it may have others. */
enum { MECHANE_GRASP_FORCE = 1, MECHANE_GRASP_IMPEDANCE = 2, MECHANE_GRASP_REWIND = 4, MECHANE_GRASP_EFFECT = 5 };

typedef struct mechane_grasp mechane_grasp; /* the library's own */

/* MECHANE_GRASP_VERSION of the header that the library was built with. */
MECHANE_GRASP_EXPORT int mechane_grasp_version(void);

/* Connects to the device manager at `host` ("localhost", "192.168.1.9"); NULL: as the SDK is set up
 * [vhtIOConn::getDefault]. Returns NULL when there is no glove; mechane_grasp_error(NULL) then says why. */
MECHANE_GRASP_EXPORT mechane_grasp* mechane_grasp_open(const char* host);

/* [vhtCyberGrasp::setMode, getMode] Any program that is connected may change the mode, so get_mode has to ask the
 * controller, and not remember what it was set to. */
MECHANE_GRASP_EXPORT int mechane_grasp_set_mode(mechane_grasp* glove, int mode);
MECHANE_GRASP_EXPORT int mechane_grasp_get_mode(mechane_grasp* glove, int* mode);

/* [vhtCyberGrasp::setForce] Thumb, index, middle, ring, little; 0 none .. 1 the most that the glove can pull. They
 * hold until the next. */
MECHANE_GRASP_EXPORT int mechane_grasp_set_forces(mechane_grasp* glove, const double forces[5]);

/* Lets go of the fingers, and takes up the slack of the tendons [mode rewind]. */
MECHANE_GRASP_EXPORT int mechane_grasp_rewind(mechane_grasp* glove);

/* Disconnects. The driver has set the forces to zero and called rewind before, as far as the glove was there. */
MECHANE_GRASP_EXPORT void mechane_grasp_close(mechane_grasp* glove);

/* What went wrong last, one line of UTF-8, or "". Lives until the next call. */
MECHANE_GRASP_EXPORT const char* mechane_grasp_error(mechane_grasp* glove);

/* The library may lack the two functions that follow. They return 1 when they have filled in a sample that is new or
 * not older than 50 ms, 0 when there is none now, and below 0 when they failed. */

/* The angles of the CyberGlove under the CyberGrasp, rad. By finger from the thumb: abduction, positive towards the
 * thumb, 0 for the middle finger; then three flexions from the palm outwards, which grow as the hand closes. The
 * thumb's first one is its roll [vhtGlove::getAngle]. */
MECHANE_GRASP_EXPORT int mechane_grasp_joints(mechane_grasp* glove, double joints_rad[20]);

/* The wrist's place, m, and turn, w x y z, from a tracker: right-handed, x to the visitor's right, y up, z towards
 * the visitor, from the middle of the workspace. */
MECHANE_GRASP_EXPORT int mechane_grasp_pose(mechane_grasp* glove, double position_m[3], double orientation_wxyz[4]);

#ifdef __cplusplus
}
#endif
