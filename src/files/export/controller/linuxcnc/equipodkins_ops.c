/* LinuxCNC kinematics of the design in ../equipod_design.c, for the module interface with kins_ops (kins_module.h, kins_rt.h of LinuxCNC's development branch).
 *
 *     cd linuxcnc && halcompile --install equipodkins_ops.c
 *     loadrt kins_single_core, then loadrt equipodkins_ops ([KINS] KINEMATICS = equipodkins_ops, JOINTS = 6; LINEAR_UNITS = mm, ANGULAR_UNITS = degree)
 *
 * Pins, poses and joint values are those of equipodkins.c, whose heading explains them; the prefix of the pins is equipodkins too. What differs: the functions
 * take the machine from the block of parameters and keep nothing of their own, so that programs outside of realtime evaluate the same kinematics.
 *
 * The forward kinematics continues the pose it is given, else the last pose of its caller's scratch block, else the home pose; with
 * `reset` the home pose alone. The tool frame is the platform's:
 * tool-offset is the distance from the tip to the joints along z. The Jacobian is left to LinuxCNC, which takes differences of the inverse kinematics. */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <hal.h>
#include <kins_module.h>
#include <kins_rt.h>

#include "equipodkins.h"

MODULE_LICENSE("GPL");
MODULE_DESCRIPTION("Kinematics of a Gough-Stewart platform as functions of a block of parameters");

/* Places in the table. Leg i has four vectors: base, platform and the axes next to them. */
enum {
    BASE = 0,
    PLATFORM = 3,
    BASE_AXIS = 6,
    PLATFORM_AXIS = 9,
    OF_LEG = 12,
    CORRECTION = LEGS * OF_LEG,
    LEG_OFFSET = CORRECTION + LEGS,
    SCREW_LEAD = LEG_OFFSET + LEGS,
    SPINDLE_OFFSET,
    TOOL_OFFSET,
    FAILED,
    STATUS,
    ITERATIONS,
    CONDITION,
    RESET,
#ifdef EQUIPOD_HAS_DRIVES
    BASE_JOINT_OFFSET,
    PLATFORM_JOINT_OFFSET,
#else
    OCTAHEDRAL,
    POSITION_ERROR,
#endif
    ENTRIES
};

#define ENTRY(name, type, direction) {name, type, direction, 0, 0}
#define VECTOR(name) \
    ENTRY(name ".x", KINS_PARAM_FLOAT, KINS_IN), ENTRY(name ".y", KINS_PARAM_FLOAT, KINS_IN), ENTRY(name ".z", KINS_PARAM_FLOAT, KINS_IN)
#define LEG(n) VECTOR("base." n), VECTOR("platform." n), VECTOR("base-n." n), VECTOR("platform-n." n)

/* Defaults are those of the design, which fill_table writes. */
static kins_param_desc table[] = {
    LEG("0"), LEG("1"), LEG("2"), LEG("3"), LEG("4"), LEG("5"),
    ENTRY("correction.0", KINS_PARAM_FLOAT, KINS_OUT), ENTRY("correction.1", KINS_PARAM_FLOAT, KINS_OUT),
    ENTRY("correction.2", KINS_PARAM_FLOAT, KINS_OUT), ENTRY("correction.3", KINS_PARAM_FLOAT, KINS_OUT),
    ENTRY("correction.4", KINS_PARAM_FLOAT, KINS_OUT), ENTRY("correction.5", KINS_PARAM_FLOAT, KINS_OUT),
    ENTRY("leg-offset.0", KINS_PARAM_FLOAT, KINS_IN), ENTRY("leg-offset.1", KINS_PARAM_FLOAT, KINS_IN),
    ENTRY("leg-offset.2", KINS_PARAM_FLOAT, KINS_IN), ENTRY("leg-offset.3", KINS_PARAM_FLOAT, KINS_IN),
    ENTRY("leg-offset.4", KINS_PARAM_FLOAT, KINS_IN), ENTRY("leg-offset.5", KINS_PARAM_FLOAT, KINS_IN),
    ENTRY("screw-lead", KINS_PARAM_FLOAT, KINS_IN),
    ENTRY("spindle-offset", KINS_PARAM_FLOAT, KINS_IN),
    {"tool-offset", KINS_PARAM_FLOAT, KINS_IN, 1, 0},
    ENTRY("fwd-kins-fail", KINS_PARAM_BIT, KINS_OUT),
    ENTRY("status", KINS_PARAM_U32, KINS_OUT),
    ENTRY("last-iterations", KINS_PARAM_U32, KINS_OUT),
    ENTRY("condition", KINS_PARAM_FLOAT, KINS_OUT),
    ENTRY("reset", KINS_PARAM_BIT, KINS_IN),
#ifdef EQUIPOD_HAS_DRIVES
    ENTRY("base-joint-offset", KINS_PARAM_FLOAT, KINS_IN),
    ENTRY("platform-joint-offset", KINS_PARAM_FLOAT, KINS_IN),
#else
    ENTRY("octahedral", KINS_PARAM_BIT, KINS_IN),
    ENTRY("position-error", KINS_PARAM_FLOAT, KINS_OUT),
#endif
};

/* One size for the table, the places in it and the block of parameters. */
typedef char table_has_its_entries[sizeof table / sizeof *table == ENTRIES && (int)ENTRIES <= KINS_MAX_PARAMS ? 1 : -1];

static void fill_table(void)
{
    machine_t machine;
    int i, k;
    as_designed(&machine);
    for (i = 0; i < LEGS; i++) {
        kins_param_desc *of_leg = table + i * OF_LEG;
        for (k = 0; k < 3; k++) {
            of_leg[BASE + k].dflt = machine.base[i][k];
            of_leg[PLATFORM + k].dflt = machine.platform[i][k];
            of_leg[BASE_AXIS + k].dflt = machine.base_axis[i][k];
            of_leg[PLATFORM_AXIS + k].dflt = machine.platform_axis[i][k];
        }
        table[LEG_OFFSET + i].dflt = machine.leg_offset[i];
    }
    table[SCREW_LEAD].dflt = machine.screw_lead;
#ifdef EQUIPOD_HAS_DRIVES
    table[BASE_JOINT_OFFSET].dflt = machine.joint_offset[0];
    table[PLATFORM_JOINT_OFFSET].dflt = machine.joint_offset[1];
#endif
}

/* The machine as the block has it. */
static int machine_of(const kins_params *p, machine_t *machine)
{
    int i, k;
    for (i = 0; i < LEGS; i++) {
        const double *of_leg = p->geometry + i * OF_LEG;
        for (k = 0; k < 3; k++) {
            machine->base[i][k] = of_leg[BASE + k];
            machine->platform[i][k] = of_leg[PLATFORM + k];
            machine->base_axis[i][k] = of_leg[BASE_AXIS + k];
            machine->platform_axis[i][k] = of_leg[PLATFORM_AXIS + k];
        }
        machine->leg_offset[i] = p->geometry[LEG_OFFSET + i];
    }
    machine->screw_lead = p->geometry[SCREW_LEAD];
    machine->tool = p->geometry[SPINDLE_OFFSET] + p->tool.tran.z;
#ifdef EQUIPOD_HAS_DRIVES
    machine->joint_offset[0] = p->geometry[BASE_JOINT_OFFSET];
    machine->joint_offset[1] = p->geometry[PLATFORM_JOINT_OFFSET];
#else
    machine->octahedral = p->geometry[OCTAHEDRAL] != 0;
#endif
    return ready(machine);
}

static int forward(const kins_params *p, kins_scratch *s, const double *joint, EmcPose *pos, const KINEMATICS_FORWARD_FLAGS *fflags,
                   KINEMATICS_INVERSE_FLAGS *iflags)
{
    machine_t machine;
    equipod_pose given, last;
    equipod_result result;
    equipod_status status;
    (void)fflags;
    (void)iflags;
    s->failed = 1;
    s->out[FAILED] = 1;
    if (!machine_of(p, &machine)) {
        return -1;
    }
    pose_of_world(pos, &given);
    pose_of_world(&s->pose_seed, &last);
    status = pose_of_joints(&machine, joint, &given, s->have_pose_seed && s->pose_seed_ok ? &last : 0, p->geometry[RESET] != 0, &result);
    s->iterations = (int)result.newton_steps;
    s->out[STATUS] = status;
    s->out[ITERATIONS] = result.newton_steps;
    s->out[CONDITION] = result.frobenius_ratio;
#ifndef EQUIPOD_HAS_DRIVES
    s->out[POSITION_ERROR] = result.position_error * EQUIPOD_UNIT_MILLIMETRES;
#endif
    if (status != EQUIPOD_TRACKED) {
        return -1;
    }
    world_of_pose(&result.pose, pos);
    s->pose_seed = *pos;
    s->have_pose_seed = 1;
    s->pose_seed_ok = 1;
    s->failed = 0;
    s->out[FAILED] = 0;
    return 0;
}

static int inverse(const kins_params *p, kins_scratch *s, const EmcPose *pos, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                   KINEMATICS_FORWARD_FLAGS *fflags)
{
    machine_t machine;
    equipod_pose pose;
    double add[LEGS];
    int i;
    (void)iflags;
    (void)fflags;
    pose_of_world(pos, &pose);
    if (!machine_of(p, &machine) || !joints_at(&machine, &pose, joint, add)) {
        return -1;
    }
    for (i = 0; i < LEGS; i++) {
        s->out[CORRECTION + i] = add[i];
    }
    return 0;
}

/* The platform's axes in the base frame. There is no pose to start from but the home pose: the assembly mode is that of the home pose. */
static int tool(const kins_params *p, const double *joint, PmRotationMatrix *rot, const KINEMATICS_FORWARD_FLAGS *fflags)
{
    machine_t machine;
    equipod_result result;
    (void)fflags;
    if (!machine_of(p, &machine) || pose_from(&machine, joint, &equipod_home, &result) != EQUIPOD_TRACKED) {
        return -1;
    }
    rot->x.x = result.pose.rotation[0][0];
    rot->x.y = result.pose.rotation[1][0];
    rot->x.z = result.pose.rotation[2][0];
    rot->y.x = result.pose.rotation[0][1];
    rot->y.y = result.pose.rotation[1][1];
    rot->y.z = result.pose.rotation[2][1];
    rot->z.x = result.pose.rotation[0][2];
    rot->z.y = result.pose.rotation[1][2];
    rot->z.z = result.pose.rotation[2][2];
    return 0;
}

static const kins_ops operations = {
    .forward = forward,
    .inverse = inverse,
    .tool = tool,
    .fwd_iterates = 1,
};

const kins_module_info kins_module = {
    .name = "equipodkins_ops",
    .halprefix = "equipodkins",
    .params = table,
    .nparams = ENTRIES,
    .required_coordinates = "XYZABC",
    .max_joints = LEGS,
    .allow_duplicates = 0,
    .ntypes = 1,
    .ops = {&operations},
};

/* For a copy of the module that is loaded outside of realtime. */
int kinsDescribe(const char *coordinates, const char *sparm, kins_module_info *info)
{
    (void)coordinates;
    (void)sparm;
    fill_table();
    return kinsSingleDescribe(&kins_module, info);
}

EXPORT_SYMBOL(kinsDescribe);

static int component;

int rtapi_app_main(void)
{
    component = hal_init("equipodkins_ops");
    if (component < 0) {
        return component;
    }
    fill_table();
    if (kinsSingleInit(component, &kins_module, "XYZABC", KINEMATICS_BOTH)) {
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
