/* The kinematics module with a table of operations, called through that table as LinuxCNC calls it: poses become joint values and poses again. Standard input
 * has rows of a pose x y z a b c and the six joint values that the library has there. Exit 0: all well. */
#include <stdio.h>
#include <string.h>

#include "interface.h"

/* What the shared code of LinuxCNC does for a module with one type. */
static int started;

int kinsSingleDescribe(const kins_module_info *module, kins_module_info *info)
{
    *info = *module;
    return 0;
}

int kinsSingleInit(int component, const kins_module_info *module, const char *coordinates, KINEMATICS_TYPE type)
{
    started = component == 7 && module->ops[0]->forward && strcmp(coordinates, "XYZABC") == 0 && type == KINEMATICS_BOTH;
    return started ? 0 : -1;
}

int hal_init(const char *name)
{
    return strcmp(name, "equipodkins_ops") == 0 ? 7 : -1;
}

int hal_ready(int component)
{
    return component == 7 ? 0 : -1;
}

int hal_exit(int component)
{
    return component == 7 ? 0 : -1;
}

static int failures;

static void check(int good, const char *what)
{
    if (!good) {
        failures += 1;
        printf("differs: %s\n", what);
    }
}

static unsigned state = 5;

/* Between -1 and 1. */
static double any(void)
{
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 8388608.0 - 1;
}

/* -1: there is none. */
static int entry(const kins_module_info *module, const char *name)
{
    int i;
    for (i = 0; i < module->nparams; i++) {
        if (strcmp(module->params[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

static int place(const kins_module_info *module, const char *name)
{
    const int i = entry(module, name);
    if (i < 0) {
        printf("no entry %s\n", name);
        failures += 1;
        return 0;
    }
    return i;
}

/* The distance of the joints of leg i, from the definition, without the code under test. */
static double leg(const kins_params *p, const kins_module_info *module, const EmcPose *pose, int i)
{
    const double k = acos(-1.0) / 180;
    const double a[3] = {pose->a * k, pose->b * k, pose->c * k};
    double sum = 0, v[3], w[3];
    const double p0[3] = {pose->tran.x, pose->tran.y, pose->tran.z};
    char name[32];
    int j;
    for (j = 0; j < 3; j++) {
        snprintf(name, sizeof name, "platform.%d.%c", i, "xyz"[j]);
        v[j] = p->geometry[place(module, name)] + (j == 2 ? p->tool.tran.z : 0);
    }
    w[0] = v[0], w[1] = cos(a[0]) * v[1] - sin(a[0]) * v[2], w[2] = sin(a[0]) * v[1] + cos(a[0]) * v[2];
    v[0] = cos(a[1]) * w[0] + sin(a[1]) * w[2], v[1] = w[1], v[2] = cos(a[1]) * w[2] - sin(a[1]) * w[0];
    w[0] = cos(a[2]) * v[0] - sin(a[2]) * v[1], w[1] = sin(a[2]) * v[0] + cos(a[2]) * v[1], w[2] = v[2];
    for (j = 0; j < 3; j++) {
        double d;
        snprintf(name, sizeof name, "base.%d.%c", i, "xyz"[j]);
        d = w[j] + p0[j] - p->geometry[place(module, name)] - (j == 2 ? p->tool.tran.z : 0);
        sum += d * d;
    }
    return sqrt(sum);
}

static double off(const EmcPose *a, const EmcPose *b, double size)
{
    const double x[6] = {(a->tran.x - b->tran.x) / size, (a->tran.y - b->tran.y) / size, (a->tran.z - b->tran.z) / size,
                         (a->a - b->a) / 57.3, (a->b - b->b) / 57.3, (a->c - b->c) / 57.3};
    double worst = 0;
    int i;
    for (i = 0; i < 6; i++) {
        worst = fmax(worst, fabs(x[i]));
    }
    return worst;
}

int main(void)
{
    kins_module_info module;
    kins_params p;
    kins_scratch s;
    EmcPose home, lost;
    double joints[EMCMOT_MAX_JOINTS], again[EMCMOT_MAX_JOINTS], size = 0, worst = 0;
    int i, n, octahedral, screws, drives, poses = 0, rows = 0, length_errors = 0;
    check(rtapi_app_main() == 0 && started, "the module starts");
    check(kinsDescribe("XYZABC", "", &module) == 0 && module.ntypes == 1, "the module describes itself");
    check(module.nparams <= KINS_MAX_PARAMS && module.ops[0]->fwd_iterates, "the table fits");
    for (i = 0; i < module.nparams; i++) {
        for (n = 0; n < i; n++) {
            check(strcmp(module.params[i].name, module.params[n].name) != 0, "names are different");
        }
    }
    memset(&p, 0, sizeof p);
    memset(&s, 0, sizeof s);
    p.size = sizeof p;
    p.max_joints = module.max_joints;
    for (i = 0; i < module.nparams; i++) {
        p.geometry[i] = module.params[i].dflt;
        size = fmax(size, fabs(p.geometry[i]));
    }
    /* lengths of the home pose, whose joint values the module finds again from nothing: the pose of all zeros is no start */
    memset(&home, 0, sizeof home);
    home.tran.z = HOME_Z;
    for (;; rows++) {
        EmcPose pose = home;
        double own[6];
        const int got = scanf("%lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", &pose.tran.x, &pose.tran.y, &pose.tran.z, &pose.a, &pose.b, &pose.c, own,
                              own + 1, own + 2, own + 3, own + 4, own + 5);
        if (got != 12) {
            break;
        }
        check(module.ops[0]->inverse(&p, &s, &pose, joints, 0, 0) == 0, "joint values of a row");
        for (i = 0; i < 6; i++) {
            check(fabs(joints[i] - own[i]) <= 1e-12 * size, "joint values of the library");
        }
    }
    check(rows > 0, "there are rows");
    drives = entry(&module, "base-joint-offset") >= 0;
    for (octahedral = 0; octahedral < (drives ? 1 : 2); octahedral++) {
        for (screws = 0; screws < 2; screws++) {
            if (!drives) {
                p.geometry[place(&module, "octahedral")] = octahedral;
            }
            p.geometry[place(&module, "screw-lead")] = screws ? 0.02 * size : module.params[place(&module, "screw-lead")].dflt;
            p.tool.tran.z = screws * 0.05 * size;
            memset(&s, 0, sizeof s);
            for (n = 0; n < 100; n++) {
                EmcPose pose = home, start;
                pose.tran.x += 0.05 * size * any(), pose.tran.y += 0.05 * size * any(), pose.tran.z += 0.05 * size * any();
                pose.a = 12 * any(), pose.b = 12 * any(), pose.c = 12 * any();
                check(module.ops[0]->inverse(&p, &s, &pose, joints, 0, 0) == 0, "joint values");
                for (i = 0; i < 6; i++) {
                    char name[32];
                    double added;
                    snprintf(name, sizeof name, "correction.%d", i);
                    added = s.out[place(&module, name)];
                    length_errors += !(fabs(joints[i] - added - leg(&p, &module, &pose, i)) <= 1e-12 * size) || (!screws && !drives && added != 0);
                }
                if (p.tool.tran.z != 0) {
                    /* a tool moves the pose that is told and nothing else: the machine without it has the same joint values */
                    const double k = acos(-1.0) / 180, o = p.tool.tran.z, a = pose.a * k, b = pose.b * k, c = pose.c * k;
                    kins_params bare = p;
                    EmcPose moved = pose;
                    bare.tool.tran.z = 0;
                    moved.tran.x += o * (cos(c) * sin(b) * cos(a) + sin(c) * sin(a));
                    moved.tran.y += o * (sin(c) * sin(b) * cos(a) - cos(c) * sin(a));
                    moved.tran.z += o * (cos(b) * cos(a) - 1);
                    check(module.ops[0]->inverse(&bare, &s, &moved, again, 0, 0) == 0, "joint values without a tool");
                    for (i = 0; i < 6; i++) {
                        check(fabs(again[i] - joints[i]) <= 1e-12 * size, "joint values do not depend on the tool");
                    }
                }
                start = pose;
                if (n % 2) {
                    start.tran.x += 1e-3 * size, start.b += 0.05;
                } else {
                    memset(&start, 0, sizeof start);
                }
                if (module.ops[0]->forward(&p, &s, joints, &start, 0, 0) != 0) {
                    check(0, "a pose");
                    continue;
                }
                poses += 1;
                worst = fmax(worst, off(&start, &pose, size));
                check(!s.failed && s.have_pose_seed && s.pose_seed_ok && s.out[place(&module, "fwd-kins-fail")] == 0, "what the scratch says");
                check(module.ops[0]->inverse(&p, &s, &start, again, 0, 0) == 0 && fabs(again[3] - joints[3]) < 1e-9 * size, "joint values again");
                {
                    PmRotationMatrix r;
                    const double k = acos(-1.0) / 180;
                    check(module.ops[0]->tool(&p, joints, &r, 0) == 0, "tool frame");
                    check(fabs(r.x.z + sin(pose.b * k)) < 1e-9 && fabs(r.y.z - sin(pose.a * k) * cos(pose.b * k)) < 1e-9, "axes of the tool frame");
                }
            }
        }
    }
    {
        /* with `reset` home is continued, whatever pose is given and whatever the last one was */
        EmcPose start = home;
        memset(&s, 0, sizeof s);
        check(module.ops[0]->inverse(&p, &s, &home, joints, 0, 0) == 0, "joint values of home");
        p.geometry[place(&module, "reset")] = 1;
        s.have_pose_seed = s.pose_seed_ok = 1;
        s.pose_seed = home;
        s.pose_seed.tran.z = start.tran.z = NAN;
        check(module.ops[0]->forward(&p, &s, joints, &start, 0, 0) == 0 && off(&start, &home, size) < 1e-9, "home after a reset");
        p.geometry[place(&module, "reset")] = 0;
        s.pose_seed.tran.x = start.tran.y = NAN;
        check(module.ops[0]->forward(&p, &s, joints, &start, 0, 0) == 0 && off(&start, &home, size) < 1e-9, "home where no start leads to a pose");
    }
    check(length_errors == 0, "leg lengths by the definition");
    check(worst < 1e-9, "poses come back");
    lost = home;
    joints[2] = 0.01 * size;
    check(module.ops[0]->forward(&p, &s, joints, &lost, 0, 0) == -1 && s.failed, "lengths that no pose has");
    rtapi_app_exit();
    printf("through the table of operations: %d poses, off by %.1e of the size, joint values of %d rows, %d failed\n", poses, worst, rows, failures);
    return failures != 0;
}
