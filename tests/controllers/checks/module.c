/* The kinematics module for LinuxCNC 2.9 with a HAL of its own: starts of the forward kinematics, `reset`, and pins of a failure. Exit 0: as
 * its heading says. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "equipodkins.c"

#include "check.h"

#define PINS 200

static struct {
    char name[64];
    void *value;
} known[PINS];
static int count;

static int new_pin(void **pin, size_t bytes, const char *form, va_list list)
{
    if (count == PINS) {
        return -1;
    }
    vsnprintf(known[count].name, sizeof known[count].name, form, list);
    *pin = known[count].value = calloc(1, bytes);
    count += 1;
    return *pin ? 0 : -1;
}

#define PIN(type, function) \
    int function(hal_pin_dir_t direction, type **pin, int id, const char *form, ...) \
    { \
        void *place; \
        va_list list; \
        int failed; \
        (void)direction; \
        (void)id; \
        va_start(list, form); \
        failed = new_pin(&place, sizeof **pin, form, list); \
        va_end(list); \
        *pin = place; \
        return failed; \
    }
PIN(hal_float_t, hal_pin_float_newf)
PIN(hal_bit_t, hal_pin_bit_newf)
PIN(hal_u32_t, hal_pin_u32_newf)

int hal_init(const char *name)
{
    return strcmp(name, NAME) == 0 ? 1 : -1;
}

int hal_ready(int id)
{
    return id == 1 ? 0 : -1;
}

int hal_exit(int id)
{
    return id == 1 ? 0 : -1;
}

void *hal_malloc(long bytes)
{
    return calloc(1, (size_t)bytes);
}

static void *pin(const char *name)
{
    int i;
    for (i = 0; i < count; i++) {
        if (strcmp(known[i].name + strlen(NAME) + 1, name) == 0) {
            return known[i].value;
        }
    }
    printf("no pin %s\n", name);
    exit(2);
}

static int near(const EmcPose *a, const EmcPose *b)
{
    return fabs(a->tran.x - b->tran.x) < 1e-6 && fabs(a->tran.y - b->tran.y) < 1e-6 && fabs(a->tran.z - b->tran.z) < 1e-6
           && fabs(a->a - b->a) < 1e-7 && fabs(a->b - b->b) < 1e-7 && fabs(a->c - b->c) < 1e-7;
}

int main(void)
{
    EmcPose home = {{0, 0, 0}, 0, 0, 0, 0, 0, 0}, below = home, zeros = home, world;
    double joints[16], wrong[16];
    hal_bit_t *reset, *failed;
    hal_u32_t *how;
    check(rtapi_app_main() == 0, "the module starts", 0);
    reset = pin("reset");
    failed = pin("fwd-kins-fail");
    how = pin("status");
    world_of_pose(&equipod_home, &home);
    check(kinematicsInverse(&home, joints, 0, 0) == 0, "joint values of home", 0);
    /* the mirror image below the base, which is planar as the platform is, has the same lengths */
    below = home;
    below.tran.z = -home.tran.z;
    check(kinematicsInverse(&below, wrong, 0, 0) == 0 && fabs(wrong[2] - joints[2]) < 1e-9, "the mirror image", 0);
    world = zeros;
    check(kinematicsForward(joints, &world, 0, 0) == 0 && near(&world, &home) && !*failed && *how == 0, "home from all zeros", 1);
    world = below;
    check(kinematicsForward(joints, &world, 0, 0) == 0 && near(&world, &below), "the pose given is continued", 2);
    /* the last pose found is the one below */
    world = zeros;
    check(kinematicsForward(joints, &world, 0, 0) == 0 && near(&world, &below), "the last pose is continued", 3);
    *reset = 1;
    world = below;
    check(kinematicsForward(joints, &world, 0, 0) == 0 && near(&world, &home), "home alone while reset is set", 4);
    world = below;
    check(kinematicsForward(wrong, &world, 0, 0) == 0 && near(&world, &home), "home again", 5);
    *reset = 0;
    world = zeros;
    check(kinematicsForward(joints, &world, 0, 0) == 0 && near(&world, &home), "the last pose is that of the reset", 6);
    /* neither the pose given nor the last one leads anywhere */
    last.rotation[0][0] = NAN;
    world = zeros;
    check(kinematicsForward(joints, &world, 0, 0) == 0 && near(&world, &home), "home is tried again", 7);
    memcpy(wrong, joints, sizeof wrong);
    wrong[1] *= 0.1;
    world = home;
    check(kinematicsForward(wrong, &world, 0, 0) == -1 && *failed && *how != 0, "lengths that no pose has", 8);
    check(isinf(*(double *)pin("position-error")), "the bound of no pose", 9);
    check(near(&world, &home), "the world of no pose stays", 10);
    *(double *)pin("tool-offset") = NAN;
    check(kinematicsForward(joints, &world, 0, 0) == -1 && *failed, "a tool that is no number", 11);
    check(kinematicsInverse(&home, wrong, 0, 0) == -1, "joint values with a tool that is no number", 12);
    rtapi_app_exit();
    printf("%d pins, %u failed\n", count, failures);
    return failures != 0;
}
