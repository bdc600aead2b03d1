/* The driver of a device that is not there, for tests: a stylus that goes down into a floor and stays in it, and that fails as its options
 * say. Plain C, from mechane/driver.h alone. Each force that it is given is appended to a file, with the time. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <mechane/driver.h>

#ifndef FAKE_VERSION
#define FAKE_VERSION MECHANE_DRIVER_VERSION
#endif

/* In the trace: when write() was called (CLOCK_MONOTONIC, ns; negative: close() was), and the force upwards, N. */
typedef struct {
  int64_t at_ns;
  double force_n;
} Written;

typedef struct {
  char fault[32];
  long after; /* reads */
  long reads;
  int trace;
  char pose[256];  /* of a glove: the file with its angles */
  char sinks[256]; /* the file with which it goes down */
  long sank;       /* the read at which it began */
  double joints[20];
  double palm_m;
  uint32_t side;
} Device;

static int opened = 0; /* how often in this process */

static int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static int fails(char* why, size_t why_size, const char* what) {
  snprintf(why, why_size, "%s", what);
  return 1;
}

/* A file of another length is just being written. */
static void read_pose(Device* d) {
  double joints[21];
  const int file = open(d->pose, O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  if (read(file, joints, sizeof(joints)) == sizeof(d->joints)) memcpy(d->joints, joints, sizeof(d->joints));
  close(file);
}

/* "trace=FILE,fault=WORD,after=READS,until=FILE,sinks=FILE,pose=FILE,side=left,palm=METRES": absent until this file is there; goes down
 * once that one is, and without one after 0.7 s; a glove with the 20 angles of the third */
static int fake_open(const char* options, void** device, char* why, size_t why_size) {
  Device* made = calloc(1, sizeof(Device));
  char text[512];
  snprintf(text, sizeof(text), "%s", options);
  made->trace = -1;
  made->sank = 700; /* first it is free, for the force's ramp */
  char* rest = NULL;
  for (char* word = strtok_r(text, ",", &rest); word != NULL; word = strtok_r(NULL, ",", &rest)) {
    if (strncmp(word, "trace=", 6) == 0) made->trace = open(word + 6, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (strncmp(word, "fault=", 6) == 0) snprintf(made->fault, sizeof(made->fault), "%s", word + 6);
    if (strncmp(word, "after=", 6) == 0) made->after = atol(word + 6);
    if (strncmp(word, "pose=", 5) == 0) snprintf(made->pose, sizeof(made->pose), "%s", word + 5);
    if (strncmp(word, "sinks=", 6) == 0) snprintf(made->sinks, sizeof(made->sinks), "%s", word + 6), made->sank = LONG_MAX;
    if (strcmp(word, "side=left") == 0) made->side = MECHANE_HAND_LEFT;
    if (strncmp(word, "palm=", 5) == 0) made->palm_m = atof(word + 5);
    if (strncmp(word, "until=", 6) == 0 && access(word + 6, F_OK) != 0) strcpy(made->fault, "absent");
  }
  ++opened;
  if (strcmp(made->fault, "absent") == 0 || (strcmp(made->fault, "unplugged") == 0 && opened > 1)) {
    free(made);
    return fails(why, why_size, "the fake device is not there; plug it in");
  }
  if (strcmp(made->fault, "null") == 0) {
    free(made);
    return 0;
  }
  read_pose(made); /* else a hand that shows another pose than the first one would seem to move */
  *device = made;
  return 0;
}

static int fake_describe(void* device, mechane_device_info* info, char* why, size_t why_size) {
  const Device* d = device;
  (void)why, (void)why_size;
  memset(info, 0, sizeof(*info));
  snprintf(info->name, sizeof(info->name), "Fake stylus");
  info->hand = d->pose[0] != 0 ? MECHANE_HAND_GLOVE : MECHANE_HAND_POINT;
  info->side = d->side;
#if FAKE_VERSION < 2
  info->side = 0xcdcdcdcd; /* in its time nothing was there but padding */
#endif
  info->output = MECHANE_OUTPUT_FORCE;
  info->peak_force_n = strcmp(d->fault, "limits") == 0 ? 1000 : 2;
  if (strcmp(d->fault, "other") == 0 && opened > 1) info->peak_force_n = 8;
  info->continuous_force_n = 1;
  info->rate_hz = 1000;
  return 0;
}

static int fake_read(void* device, mechane_device_state* state, char* why, size_t why_size) {
  Device* d = device;
  const int fault = ++d->reads > d->after && d->fault[0] != 0;
  if (d->sank == LONG_MAX && d->reads % 20 == 0 && access(d->sinks, F_OK) == 0) d->sank = d->reads;
  const double depth_m = 1e-4 * (double)(d->reads > d->sank ? d->reads - d->sank : 0);
  memset(state, 0, sizeof(*state));
  state->flags = MECHANE_STATE_READY;
  state->position_m[1] = depth_m < 0.02 ? -depth_m : -0.02; /* 0.1 m/s down to 20 mm */
  state->orientation_wxyz[0] = 1;
  state->temperature = -1;
  if (d->pose[0] != 0 && d->reads % 20 == 0) read_pose(d);
  memcpy(state->joints_rad, d->joints, sizeof(d->joints));
#if FAKE_VERSION >= 2
  state->palm_m = d->palm_m;
#endif
  if (!fault) return 0;
  if (strcmp(d->fault, "nan") == 0) state->position_m[0] = NAN;
  if (strcmp(d->fault, "no_rotation") == 0) state->orientation_wxyz[0] = 0;
  if (strcmp(d->fault, "slow") == 0) nanosleep(&(struct timespec){.tv_nsec = 300000000}, NULL);
  if (strcmp(d->fault, "exit") == 0) exit(3);
  if (strcmp(d->fault, "hot") == 0) state->flags |= MECHANE_STATE_HOT;
  if (strcmp(d->fault, "let_go") == 0) state->flags |= MECHANE_STATE_DEAD_MAN;
  if (strcmp(d->fault, "not_ready") == 0) state->flags = 0;
  if (strcmp(d->fault, "uncalibrated") == 0) state->flags |= MECHANE_STATE_UNCALIBRATED;
  if (strcmp(d->fault, "clutch") == 0) state->buttons = 2; /* no fault */
  if (strcmp(d->fault, "crash") == 0) abort();
  if (strcmp(d->fault, "hang") == 0) pause();
  if (strcmp(d->fault, "other") == 0 && opened > 1) return 0;
  const int pulled = strcmp(d->fault, "gone") == 0 || strcmp(d->fault, "unplugged") == 0 || strcmp(d->fault, "other") == 0;
  if (pulled) return fails(why, why_size, "the fake cable was pulled");
  return 0;
}

static int trace(const Device* d, int64_t at_ns, double force_n) {
  const Written written = {at_ns, force_n};
  return d->trace < 0 || write(d->trace, &written, sizeof(written)) == sizeof(written) ? 0 : 1;
}

static int fake_write(void* device, const mechane_device_force* force, char* why, size_t why_size) {
  return trace(device, now_ns(), force->force_n[1]) == 0 ? 0 : fails(why, why_size, strerror(errno));
}

static void fake_close(void* device) {
  Device* d = device;
  (void)trace(d, -now_ns(), 0);
  if (d->trace >= 0) close(d->trace);
  free(d);
}

const mechane_driver_table* mechane_driver(uint32_t version) {
  static const mechane_driver_table table = {FAKE_VERSION,  "a stylus that is not there", "trace=FILE fault=WORD after=READS", fake_open,
                                             fake_describe, fake_read, fake_write, fake_close};
  return version == FAKE_VERSION ? &table : NULL;
}
