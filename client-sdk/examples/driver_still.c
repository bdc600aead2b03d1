/* A driver that is as small as a driver can be: a hand that stands still. To be built outside this tree:
 *   cc -std=c11 -shared -fPIC -I /usr/local/include driver_still.c \
 *     -o /usr/local/lib/mechane/drivers/mechane_driver_still.so
 * Then: mechane devices --test still:height=0.1 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <mechane/driver.h>

typedef struct {
  double height_m;
} Still;

static int still_open(const char* options, void** device, char* why, size_t why_size) {
  Still* made = malloc(sizeof(Still));
  if (made != NULL && (options[0] == 0 || sscanf(options, "height=%lf", &made->height_m) == 1)) {
    if (options[0] == 0) made->height_m = 0;
    *device = made;
    return 0;
  }
  snprintf(why, why_size, "the options are '%s'; write height=METRES", options);
  free(made);
  return 1;
}

static int still_describe(void* device, mechane_device_info* info, char* why, size_t why_size) {
  (void)device, (void)why, (void)why_size;
  memset(info, 0, sizeof(*info));
  strcpy(info->name, "A hand that stands still");
  info->hand = MECHANE_HAND_POINT;
  info->output = MECHANE_OUTPUT_NONE;
  info->rate_hz = 1000;
  return 0;
}

static int still_read(void* device, mechane_device_state* state, char* why, size_t why_size) {
  const Still* still = device;
  (void)why, (void)why_size;
  memset(state, 0, sizeof(*state));
  state->flags = MECHANE_STATE_READY;
  state->position_m[1] = still->height_m;
  state->orientation_wxyz[0] = 1;
  state->temperature = -1;
  return 0;
}

static int still_write(void* device, const mechane_device_force* force, char* why, size_t why_size) {
  (void)device, (void)force, (void)why, (void)why_size;
  return 0;
}

static void still_close(void* device) { free(device); }

const mechane_driver_table* mechane_driver(uint32_t version) {
  static const mechane_driver_table table = {MECHANE_DRIVER_VERSION, "a hand that stands still, as an example", "height=METRES", still_open,
                                             still_describe,         still_read, still_write, still_close};
  return version == MECHANE_DRIVER_VERSION ? &table : NULL;
}
