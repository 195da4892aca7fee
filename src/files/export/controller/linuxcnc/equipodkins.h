/* Computations of both kinematics modules for LinuxCNC: equipodkins.c for 2.9 and equipodkins_ops.c for the interface with kins_ops.
 * Each module includes this file once, after its headers. This file keeps nothing between calls.
 * The folder of this file stays in the folder of equipod.c, which it includes with the numbers of the design. */
#ifndef EQUIPODKINS_H
#define EQUIPODKINS_H

#include "../equipod.c"
#include "../equipod_design.c"
#ifdef EQUIPOD_HAS_DRIVES
/* both files are one here, and have helpers of the same names */
#define dot dot_of_drives
#define cross cross_of_drives
#define is_finite is_finite_of_drives
#define invert invert_of_drives
#include "../equipod_drives.c"
#undef dot
#undef cross
#undef is_finite
#undef invert
#endif

#ifdef EQUIPOD_FLOAT
#error "the modules for LinuxCNC compute in double"
#endif

#define LEGS 6
/* Segments of a path. */
#define SEGMENTS 200u
#define DEGREE 0.017453292519943295
#define TWO_PI 6.283185307179586
/* Angles of a world are counted in the turn of the angles before, up to ten thousand turns. */
#define FAR_TURNED 3.6e6

/* A machine as it was measured, which is what the pins say: joints, the axes next to base and platform, lead, and what tool and spindle add to z of all
 * joints, and what each joint value is longer than the length of its leg (leg offsets of a calibration); millimetres. `ready` makes the rest of it. */
typedef struct {
    double base[LEGS][3], platform[LEGS][3];
    double base_axis[LEGS][3], platform_axis[LEGS][3];
    double screw_lead, tool, leg_offset[LEGS];
    equipod_legs legs;
#ifdef EQUIPOD_HAS_DRIVES
    double joint_offset[2];
    equipod_drives drives;
#else
    int octahedral;
#ifdef EQUIPOD_HAS_OCTAHEDRAL
    equipod_legs bare; /* the legs without tool and spindle, where `octahedral` is set */
#endif
#endif
} machine_t;

/* The machine as it was designed. */
static void as_designed(machine_t *machine)
{
    int i, k;
    for (i = 0; i < LEGS; i++) {
#ifdef EQUIPOD_HAS_LEG_OFFSETS
        machine->leg_offset[i] = equipod_leg_offsets[i] * EQUIPOD_UNIT_MILLIMETRES;
#else
        machine->leg_offset[i] = 0;
#endif
        for (k = 0; k < 3; k++) {
            machine->base[i][k] = equipod_nominal.base[i][k] * EQUIPOD_UNIT_MILLIMETRES;
            machine->platform[i][k] = equipod_nominal.platform[i][k] * EQUIPOD_UNIT_MILLIMETRES;
#ifdef EQUIPOD_HAS_DRIVES
            machine->base_axis[i][k] = equipod_design_drives.axis[0][i][k];
            machine->platform_axis[i][k] = equipod_design_drives.axis[1][i][k];
#else
            machine->base_axis[i][k] = equipod_across_base[i][k];
            machine->platform_axis[i][k] = equipod_across_platform[i][k];
#endif
        }
    }
    machine->tool = 0;
#ifdef EQUIPOD_HAS_DRIVES
    machine->screw_lead = equipod_design_drives.lead * TWO_PI * EQUIPOD_UNIT_MILLIMETRES;
    machine->joint_offset[0] = equipod_design_drives.offset[0] * EQUIPOD_UNIT_MILLIMETRES;
    machine->joint_offset[1] = equipod_design_drives.offset[1] * EQUIPOD_UNIT_MILLIMETRES;
#else
    machine->screw_lead = 0;
    machine->octahedral = 0;
#endif
}

static int legs_with(const machine_t *machine, double tool, equipod_legs *legs)
{
    double base[LEGS][3], platform[LEGS][3];
    int i, k;
    for (i = 0; i < LEGS; i++) {
        for (k = 0; k < 3; k++) {
            const double more = k == 2 ? tool : 0;
            base[i][k] = (machine->base[i][k] + more) / EQUIPOD_UNIT_MILLIMETRES;
            platform[i][k] = (machine->platform[i][k] + more) / EQUIPOD_UNIT_MILLIMETRES;
        }
    }
    return equipod_prepare(base, platform, legs);
}

/* A result of which nothing is known yet. */
static void no_result(const equipod_pose *start, equipod_result *result)
{
    result->status = EQUIPOD_LOST;
    result->reason = EQUIPOD_NO_CONVERGENCE;
    result->pose = *start;
    result->fraction = 0;
    result->segments = 0;
    result->newton_steps = 0;
    result->kantorovich = 0;
    result->frobenius_ratio = 0;
    result->residual = 0;
    result->distance = 0;
    result->position_error = INFINITY;
    result->angle_error = INFINITY;
}

/* Whether a length or joint value is positive and finite. */
static int is_length(double length)
{
    return length > 0 && is_finite(length);
}

#ifdef EQUIPOD_HAS_DRIVES
/* What axes, offsets and lead make of the lengths of drives. Legs are turned by nothing at home without a tool, whatever tool is mounted. */
static int drives_of(machine_t *machine)
{
    equipod_drives *drives = &machine->drives;
    equipod_legs bare;
    equipod_drive_state at_home;
    int i;
    *drives = equipod_design_drives;
    for (i = 0; i < LEGS; i++) {
        /* an axis without a direction makes legs that need one have no length */
        (void)unit(machine->base_axis[i], drives->axis[0][i]);
        (void)unit(machine->platform_axis[i], drives->axis[1][i]);
        drives->turned[i] = 0;
    }
    drives->offset[0] = machine->joint_offset[0] / EQUIPOD_UNIT_MILLIMETRES;
    drives->offset[1] = machine->joint_offset[1] / EQUIPOD_UNIT_MILLIMETRES;
    drives->lead = machine->screw_lead / EQUIPOD_UNIT_MILLIMETRES / TWO_PI;
    if (drives->lead == 0) {
        return 1;
    }
    if (!legs_with(machine, 0, &bare) || equipod_drive_states(drives, &bare, &equipod_home, &at_home)) {
        return 0;
    }
    for (i = 0; i < LEGS; i++) {
        drives->turned[i] = at_home.twist[i];
    }
    return 1;
}

static int ready(machine_t *machine)
{
    return legs_with(machine, machine->tool, &machine->legs) && drives_of(machine);
}

/* The pose whose drives have the lengths of the joints, by the fixed point of equipod_track_drives, whose steps are told as those of Newton's method. */
static equipod_status pose_from(const machine_t *machine, const double joints[LEGS], const equipod_pose *start, equipod_result *result)
{
    equipod_drive_result found;
    double lengths[LEGS];
    int i;
    for (i = 0; i < LEGS; i++) {
        lengths[i] = (joints[i] - machine->leg_offset[i]) / EQUIPOD_UNIT_MILLIMETRES;
    }
    (void)equipod_track_drives(&machine->drives, &machine->legs, lengths, start, EQUIPOD_SINGULAR, SEGMENTS, &found);
    if (found.steps == 0) {
        no_result(start, result);
        return result->status;
    }
    *result = found.near;
    result->newton_steps = found.steps;
    if (found.status != EQUIPOD_DRIVES_REACHED && result->status != EQUIPOD_NEAR_SINGULAR) {
        result->status = EQUIPOD_LOST;
    }
    return result->status;
}

/* Joint values at a pose, and what the lengths of the drives are longer than the distances of the joints, millimetres; 0 where a drive has no length. */
static int joints_at(const machine_t *machine, const equipod_pose *pose, double joints[LEGS], double add[LEGS])
{
    equipod_drive_state state;
    int i;
    if (equipod_drive_states(&machine->drives, &machine->legs, pose, &state)) {
        return 0;
    }
    for (i = 0; i < LEGS; i++) {
        add[i] = state.correction[i] * EQUIPOD_UNIT_MILLIMETRES;
        joints[i] = (state.distance[i] + state.correction[i]) * EQUIPOD_UNIT_MILLIMETRES;
        if (!is_length(joints[i])) {
            return 0;
        }
        joints[i] += machine->leg_offset[i];
    }
    return 1;
}
#else
/* Rounds in which the turn of the screws is taken into account. */
#define ROUNDS 30

static int ready(machine_t *machine)
{
#ifdef EQUIPOD_HAS_OCTAHEDRAL
    if (machine->octahedral && !legs_with(machine, 0, &machine->bare)) {
        return 0;
    }
#endif
    return legs_with(machine, machine->tool, &machine->legs);
}

/* What the screws add to each leg at a pose, in the unit of the design; 0 where an axis points along its leg. */
static int corrections(const machine_t *machine, const equipod_legs *legs, const equipod_pose *pose, double out[LEGS])
{
    const double lead = machine->screw_lead / EQUIPOD_UNIT_MILLIMETRES;
    int i, k;
    for (i = 0; i < LEGS; i++) {
        double arm[3], u[3], n[3], m[3], own[3], across[3], along_n, along_m, length, sine;
        out[i] = 0;
        if (lead == 0) {
            continue;
        }
        leg_line(legs, pose, i, arm, u);
        length = norm(u);
        for (k = 0; k < 3; k++) {
            u[k] /= length;
            n[k] = machine->base_axis[i][k];
            own[k] = machine->platform_axis[i][k];
        }
        for (k = 0; k < 3; k++) {
            m[k] = dot(pose->rotation[k], own);
        }
        along_n = dot(n, u);
        along_m = dot(m, u);
        for (k = 0; k < 3; k++) {
            n[k] -= along_n * u[k];
            m[k] -= along_m * u[k];
        }
        cross(n, m, across);
        sine = dot(u, across) / (norm(n) * norm(m));
        if (!(fabs(sine) <= 1 + 1e-12)) {
            return 0;
        }
        out[i] = lead * asin(sine > 1 ? 1 : sine < -1 ? -1 : sine) / TWO_PI;
    }
    return 1;
}

/* One path to a pose of these legs. A tracked pose has a finite bound of its error. */
static void track(const machine_t *machine, const equipod_legs *legs, const double s[LEGS], const equipod_pose *from, equipod_result *result)
{
#ifdef EQUIPOD_HAS_OCTAHEDRAL
    if (machine->octahedral) {
        (void)equipod_track_mapped(&equipod_to_octahedral, &equipod_octahedral, legs, s, from, EQUIPOD_SINGULAR, SEGMENTS, 3, result);
        return;
    }
#endif
    (void)machine;
    (void)equipod_track(legs, s, 0, from, EQUIPOD_SINGULAR, SEGMENTS, result);
    if (result->status == EQUIPOD_TRACKED && !is_finite(result->position_error)) {
        result->status = EQUIPOD_LOST;
        result->reason = EQUIPOD_NO_CONVERGENCE;
    }
}

/* The pose whose legs, with the corrections of the screws, have the lengths of the joints. Each round subtracts the corrections at the
 * last pose. */
static void follow(const machine_t *machine, const equipod_legs *legs, const double joints[LEGS], const equipod_pose *start, equipod_result *result)
{
    double add[LEGS], s[LEGS], change, before[LEGS];
    equipod_pose from = *start;
    unsigned steps = 0;
    int round, i;
    no_result(start, result);
    if (!corrections(machine, legs, &from, add)) {
        return;
    }
    for (round = 0; round < ROUNDS; round++) {
        for (i = 0; i < LEGS; i++) {
            const double length = (joints[i] - machine->leg_offset[i]) / EQUIPOD_UNIT_MILLIMETRES - add[i];
            if (!is_length(length)) {
                result->status = EQUIPOD_LOST;
                return;
            }
            s[i] = length * length;
            before[i] = add[i];
        }
        track(machine, legs, s, &from, result);
        steps += result->newton_steps;
        result->newton_steps = steps;
        if (result->status != EQUIPOD_TRACKED) {
            return;
        }
        from = result->pose;
        if (!corrections(machine, legs, &from, add)) {
            break;
        }
        change = 0;
        for (i = 0; i < LEGS; i++) {
            change = fmax(change, fabs(add[i] - before[i]));
        }
        if (change <= 1e-13 * legs->unit) {
            return;
        }
    }
    result->status = EQUIPOD_LOST;
    result->reason = EQUIPOD_NO_CONVERGENCE;
}

#ifdef EQUIPOD_HAS_OCTAHEDRAL
/* p + by (R e_z - e_z). With the length of the tool this is the pose of the platform without the tool; with its negative it is the pose with it. */
static void move_origin(double by, const equipod_pose *pose, equipod_pose *moved)
{
    int k;
    *moved = *pose;
    for (k = 0; k < 3; k++) {
        moved->position[k] += by * (pose->rotation[k][2] - (k == 2 ? 1 : 0));
    }
}
#endif

/* The pose for joint values that continues `start`. The map to the octahedral platform is one of the joints without a tool. */
static equipod_status pose_from(const machine_t *machine, const double joints[LEGS], const equipod_pose *start, equipod_result *result)
{
#ifdef EQUIPOD_HAS_OCTAHEDRAL
    if (machine->octahedral) {
        const double tool = machine->tool / EQUIPOD_UNIT_MILLIMETRES;
        equipod_pose bare;
        move_origin(tool, start, &bare);
        follow(machine, &machine->bare, joints, &bare, result);
        move_origin(-tool, &result->pose, &result->pose);
        if (result->status == EQUIPOD_TRACKED) {
            result->position_error += fabs(tool) * result->angle_error * UP;
            result->position_error += 12 * U * (2 * fabs(tool) + norm(result->pose.position));
        }
        return result->status;
    }
#endif
    follow(machine, &machine->legs, joints, start, result);
    return result->status;
}

/* Joint values at a pose, and what the screws add to them, millimetres; 0 where a leg has no length or an axis no direction. */
static int joints_at(const machine_t *machine, const equipod_pose *pose, double joints[LEGS], double add[LEGS])
{
    int i;
    if (!corrections(machine, &machine->legs, pose, add)) {
        return 0;
    }
    equipod_lengths(&machine->legs, pose, joints);
    for (i = 0; i < LEGS; i++) {
        if (!(joints[i] > 0)) {
            return 0;
        }
        joints[i] = (joints[i] + add[i]) * EQUIPOD_UNIT_MILLIMETRES + machine->leg_offset[i];
        add[i] *= EQUIPOD_UNIT_MILLIMETRES;
        if (!is_finite(joints[i])) {
            return 0;
        }
    }
    return 1;
}
#endif

/* The pose for joint values: it continues the pose given, else the last pose found (null: none), else the home pose. With `reset` it
 * continues the home pose alone. The result of no pose is that of the path from the last pose, or from home. */
static equipod_status pose_of_joints(const machine_t *machine, const double joints[LEGS], const equipod_pose *given, const equipod_pose *last,
                                     int reset, equipod_result *result)
{
    const equipod_pose *const starts[3] = {given, last, &equipod_home};
    const int told = last && !reset ? 1 : 2;
    int n;
    for (n = reset ? 2 : 0; n < 3; n++) {
        equipod_result found;
        if (!starts[n]) {
            continue;
        }
        (void)pose_from(machine, joints, starts[n], &found);
        if (n == told || found.status == EQUIPOD_TRACKED) {
            *result = found;
        }
        if (found.status == EQUIPOD_TRACKED) {
            break;
        }
    }
    return result->status;
}

static void pose_of_world(const EmcPose *world, equipod_pose *pose)
{
    double position[3], angles[3];
    position[0] = world->tran.x / EQUIPOD_UNIT_MILLIMETRES;
    position[1] = world->tran.y / EQUIPOD_UNIT_MILLIMETRES;
    position[2] = world->tran.z / EQUIPOD_UNIT_MILLIMETRES;
    angles[0] = world->a * DEGREE;
    angles[1] = world->b * DEGREE;
    angles[2] = world->c * DEGREE;
    equipod_pose_from_angles(position, angles, pose);
}

/* The angle of the same turn next to the one before; the angle itself where that one is not finite or rounds away the turn. */
static double next_to(double angle, double before)
{
    return fabs(before) <= FAR_TURNED ? angle + 360 * floor((before - angle) / 360 + 0.5) : angle;
}

static void world_of_pose(const equipod_pose *pose, EmcPose *world)
{
    double angles[3];
    equipod_angles(pose, angles);
    world->tran.x = pose->position[0] * EQUIPOD_UNIT_MILLIMETRES;
    world->tran.y = pose->position[1] * EQUIPOD_UNIT_MILLIMETRES;
    world->tran.z = pose->position[2] * EQUIPOD_UNIT_MILLIMETRES;
    world->a = next_to(angles[0] / DEGREE, world->a);
    world->b = next_to(angles[1] / DEGREE, world->b);
    world->c = next_to(angles[2] / DEGREE, world->c);
}

#endif
