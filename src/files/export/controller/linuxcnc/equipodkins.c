/* LinuxCNC kinematics of the design in ../equipod_design.c, for the module interface of LinuxCNC 2.9.
 *
 *     cd linuxcnc && halcompile --install equipodkins.c         (or --compile)
 *     [KINS] KINEMATICS = equipodkins, JOINTS = 6; LINEAR_UNITS = mm, ANGULAR_UNITS = degree
 *
 * The machine position X Y Z A B C is the pose: p = (X, Y, Z), R = Rz(C) Ry(B) Rx(A), degrees. Joint N is the length that leg N shows, from 0, in
 * millimetres. Pins, with N from 0 to 5 (in: read at every call, what is written into them is what the machine was measured to have):
 *
 *     equipodkins.base.N.x .y .z, .platform.N.x .y .z      joints, millimetres; those of the design before anything is set
 *     equipodkins.base-n.N.x .y .z, .platform-n.N.x .y .z  axes of the joints next to base and platform, base and platform frame
 *     equipodkins.leg-offset.N                             what joint N is longer than leg N: the offsets of the calibration, 0 without one
 *     equipodkins.screw-lead                               travel of a turn of the screws, right-hand positive; 0: no correction
 *     equipodkins.spindle-offset, .tool-offset             added to z of all joints, as genhexkins has them
 *     equipodkins.octahedral                               1: poses by the octahedral platform, corrected on the joints above
 *     equipodkins.reset                                    1: poses continue the home pose alone, and the last pose is forgotten
 * out:
 *     equipodkins.correction.N                             what the screws add to leg N at the last inverse kinematics
 *     equipodkins.fwd-kins-fail, .status, .last-iterations 1: no pose; 0 tracked, 1 near a singularity, 2 lost; Newton steps
 *     equipodkins.condition, .position-error               6 / (|J| |J^-1|), 0 at a singularity; bound of the error, millimetres
 *
 * Screws that are not kept from turning change their length as their joints turn against each other. With u along the leg, n the axis at the
 * base and m = R n' that at the platform, and the parts of n and m across u: correction = lead asin(u . (n x m)) / (2 pi).
 *
 * If the joints of the design are not ideal (equipod_drives.h), joint N is the length of drive N. `correction` is its excess over the distance of its joints;
 * base-n and platform-n are the first axes of the joints, and screw-lead begins as the design has it, with no leg twisted at home. Two pins replace `octahedral`
 * and `position-error`:
 *
 *     equipodkins.base-joint-offset, .platform-joint-offset  from the first to the second axis of the joints, millimetres
 *
 * and last-iterations counts steps of the fixed point of the corrections.
 *
 * The forward kinematics continues the pose it is given. Where this pose leads to no tracked pose (LinuxCNC begins with all zeros), it
 * continues the last pose it found, and then the home pose of the design. Set `reset` while the machine is homed again: the machine may
 * have been moved by hand. */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <hal.h>
#include <kinematics.h>

#include "equipodkins.h"

MODULE_LICENSE("GPL");
MODULE_DESCRIPTION("Kinematics of a Gough-Stewart platform, each pose with a test that it is the continuation of the last");

#define NAME "equipodkins"

typedef struct {
    hal_float_t *base[LEGS][3], *platform[LEGS][3];
    hal_float_t *base_axis[LEGS][3], *platform_axis[LEGS][3];
    hal_float_t *correction[LEGS], *leg_offset[LEGS];
    hal_float_t *screw_lead, *spindle_offset, *tool_offset;
    hal_bit_t *failed, *reset;
    hal_u32_t *status, *iterations;
    hal_float_t *condition;
#ifdef EQUIPOD_HAS_DRIVES
    hal_float_t *joint_offset[2];
#else
    hal_bit_t *octahedral;
    hal_float_t *position_error;
#endif
} pins_t;

static pins_t *pins;
static int component;
static machine_t machine;
static equipod_pose last;
static int has_last;

/* The machine as the pins have it. */
static int read_machine(void)
{
    int i, k;
    for (i = 0; i < LEGS; i++) {
        for (k = 0; k < 3; k++) {
            machine.base[i][k] = *pins->base[i][k];
            machine.platform[i][k] = *pins->platform[i][k];
            machine.base_axis[i][k] = *pins->base_axis[i][k];
            machine.platform_axis[i][k] = *pins->platform_axis[i][k];
        }
        machine.leg_offset[i] = *pins->leg_offset[i];
    }
    machine.screw_lead = *pins->screw_lead;
    machine.tool = *pins->spindle_offset + *pins->tool_offset;
#ifdef EQUIPOD_HAS_DRIVES
    machine.joint_offset[0] = *pins->joint_offset[0];
    machine.joint_offset[1] = *pins->joint_offset[1];
#else
    machine.octahedral = *pins->octahedral;
#endif
    return ready(&machine);
}

int kinematicsForward(const double *joints, struct EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags, KINEMATICS_INVERSE_FLAGS *iflags)
{
    equipod_pose given;
    equipod_result result;
    equipod_status status;
    (void)fflags;
    (void)iflags;
    *pins->failed = 1;
    if (!read_machine()) {
        return -1;
    }
    if (*pins->reset) {
        has_last = 0;
    }
    pose_of_world(world, &given);
    status = pose_of_joints(&machine, joints, &given, has_last ? &last : 0, *pins->reset, &result);
    *pins->status = (hal_u32_t)status;
    *pins->iterations = result.newton_steps;
    *pins->condition = result.frobenius_ratio;
#ifndef EQUIPOD_HAS_DRIVES
    *pins->position_error = result.position_error * EQUIPOD_UNIT_MILLIMETRES;
#endif
    if (status != EQUIPOD_TRACKED) {
        return -1;
    }
    last = result.pose;
    has_last = 1;
    world_of_pose(&result.pose, world);
    *pins->failed = 0;
    return 0;
}

int kinematicsInverse(const struct EmcPose *world, double *joints, const KINEMATICS_INVERSE_FLAGS *iflags, KINEMATICS_FORWARD_FLAGS *fflags)
{
    equipod_pose pose;
    double add[LEGS];
    int i;
    (void)iflags;
    (void)fflags;
    pose_of_world(world, &pose);
    if (!read_machine() || !joints_at(&machine, &pose, joints, add)) {
        return -1;
    }
    for (i = 0; i < LEGS; i++) {
        *pins->correction[i] = add[i];
    }
    return 0;
}

KINEMATICS_TYPE kinematicsType(void)
{
    return KINEMATICS_BOTH;
}

KINS_NOT_SWITCHABLE
EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);

static int vector_pin(hal_float_t **pin, const char *what, int leg, const double value[3])
{
    static const char axis[3] = {'x', 'y', 'z'};
    int k, failed = 0;
    for (k = 0; k < 3; k++) {
        failed |= hal_pin_float_newf(HAL_IN, &pin[k], component, NAME ".%s.%d.%c", what, leg, axis[k]);
        if (!failed) {
            *pin[k] = value[k];
        }
    }
    return failed;
}

static int length_pin(hal_float_t **pin, const char *what, double value)
{
    const int failed = hal_pin_float_newf(HAL_IN, pin, component, NAME ".%s", what);
    if (!failed) {
        **pin = value;
    }
    return failed;
}

static int make_pins(void)
{
    int i, failed = 0;
    as_designed(&machine);
    for (i = 0; i < LEGS && !failed; i++) {
        failed |= vector_pin(pins->base[i], "base", i, machine.base[i]);
        failed |= vector_pin(pins->platform[i], "platform", i, machine.platform[i]);
        failed |= vector_pin(pins->base_axis[i], "base-n", i, machine.base_axis[i]);
        failed |= vector_pin(pins->platform_axis[i], "platform-n", i, machine.platform_axis[i]);
        failed |= hal_pin_float_newf(HAL_OUT, &pins->correction[i], component, NAME ".correction.%d", i);
        failed |= hal_pin_float_newf(HAL_IN, &pins->leg_offset[i], component, NAME ".leg-offset.%d", i);
        if (!failed) {
            *pins->leg_offset[i] = machine.leg_offset[i];
        }
    }
    failed |= length_pin(&pins->screw_lead, "screw-lead", machine.screw_lead);
    failed |= length_pin(&pins->spindle_offset, "spindle-offset", 0);
    failed |= length_pin(&pins->tool_offset, "tool-offset", 0);
    failed |= hal_pin_bit_newf(HAL_IN, &pins->reset, component, NAME ".reset");
    failed |= hal_pin_bit_newf(HAL_OUT, &pins->failed, component, NAME ".fwd-kins-fail");
    failed |= hal_pin_u32_newf(HAL_OUT, &pins->status, component, NAME ".status");
    failed |= hal_pin_u32_newf(HAL_OUT, &pins->iterations, component, NAME ".last-iterations");
    failed |= hal_pin_float_newf(HAL_OUT, &pins->condition, component, NAME ".condition");
#ifdef EQUIPOD_HAS_DRIVES
    failed |= length_pin(&pins->joint_offset[0], "base-joint-offset", machine.joint_offset[0]);
    failed |= length_pin(&pins->joint_offset[1], "platform-joint-offset", machine.joint_offset[1]);
#else
    failed |= hal_pin_bit_newf(HAL_IN, &pins->octahedral, component, NAME ".octahedral");
    failed |= hal_pin_float_newf(HAL_OUT, &pins->position_error, component, NAME ".position-error");
#endif
    return failed;
}

int rtapi_app_main(void)
{
    component = hal_init(NAME);
    if (component < 0) {
        return component;
    }
    pins = hal_malloc(sizeof *pins);
    if (!pins || make_pins()) {
        hal_exit(component);
        return -1;
    }
    hal_ready(component);
    return 0;
}

void rtapi_app_exit(void)
{
    hal_exit(component);
}
