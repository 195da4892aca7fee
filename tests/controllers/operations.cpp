// Counts the operations of equipod.c: it is compiled as C++ with a number that counts (check.py puts `counted` for `double` into equipod.h).
// Loops have fixed lengths, and what is done does not depend on the numbers but by the tests that end a way: each part is counted once.
#include <cmath>
#include <cstdio>

struct counted {
    double x;
    static long adds, products, quotients, roots;
    counted() = default;
    counted(double y) : x(y) {}
    counted(int y) : x(y) {}
    explicit operator double() const { return x; }
};
long counted::adds, counted::products, counted::quotients, counted::roots;
static counted operator+(counted a, counted b) { counted::adds++; return counted(a.x + b.x); }
static counted operator-(counted a, counted b) { counted::adds++; return counted(a.x - b.x); }
static counted operator-(counted a) { return counted(-a.x); }
static counted operator*(counted a, counted b) { counted::products++; return counted(a.x * b.x); }
static counted operator/(counted a, counted b) { counted::quotients++; return counted(a.x / b.x); }
static counted &operator+=(counted &a, counted b) { return a = a + b; }
static counted &operator-=(counted &a, counted b) { return a = a - b; }
static counted &operator*=(counted &a, counted b) { return a = a * b; }
static counted &operator/=(counted &a, counted b) { return a = a / b; }
static bool operator<(counted a, counted b) { return a.x < b.x; }
static bool operator>(counted a, counted b) { return a.x > b.x; }
static bool operator<=(counted a, counted b) { return a.x <= b.x; }
static bool operator>=(counted a, counted b) { return a.x >= b.x; }
static bool operator!=(counted a, counted b) { return a.x != b.x; }
static counted fabs(counted a) { return counted(std::fabs(a.x)); }
static counted sqrt(counted a) { counted::roots++; return counted(std::sqrt(a.x)); }
static counted sin(counted a) { return counted(std::sin(a.x)); }
static counted cos(counted a) { return counted(std::cos(a.x)); }
static counted atan2(counted a, counted b) { return counted(std::atan2(a.x, b.x)); }

#include "equipod.c"
#include "equipod_design.c"

static void begin() { counted::adds = counted::products = counted::quotients = counted::roots = 0; }
static void end(const char *name) { std::printf("%s %ld %ld %ld %ld\n", name, counted::adds, counted::products, counted::quotients, counted::roots); }

int main()
{
    equipod_pose pose = equipod_home, moved = equipod_home;
    place_t place;
    local_t here;
    blur_t blur;
    start_t start;
    real_t s[6], l[6], j[6][6], target[6], error[6], step[6];
    equipod_result r;
    pose.position[2] += equipod_nominal.unit * real_t(0.01);
    begin(); equipod_lengths(&equipod_nominal, &pose, l); end("lengths");
    begin(); equipod_jacobian(&equipod_nominal, &pose, j); end("jacobian");
    equipod_squared_lengths(&equipod_nominal, &pose, s);
    begin(); equipod_newton_steps(&equipod_nominal, s, &equipod_home, 1, &moved); end("correction");
    // once a call: target, place, rotation, the end
    begin();
    target_of(&equipod_nominal, s, 0, target, error);
    place_of(&equipod_nominal, &equipod_home, &place);
    make_rotation(&place);
    pose_of(&equipod_nominal, &place, &moved);
    measure(&equipod_nominal, target, error, &place, &place, &start, &r);
    end("call");
    // once a segment: the test, the ball, the squares between
    begin();
    local_at(&equipod_nominal, &place, target, &here);
    blur_of(&equipod_nominal, &place, &here, error, &blur);
    start_of(&here, &blur, &start);
    place_distance(&place, &place, start.epsilon);
    end("segment");
    // once a Newton step within a segment
    begin();
    local_at(&equipod_nominal, &place, target, &here);
    newton(&here, step);
    step_size(step);
    apply_step(step, &place);
    end("step");
    begin();
    equipod_track(&equipod_nominal, s, 0, &equipod_home, real_t(EQUIPOD_SINGULAR), EQUIPOD_SEGMENTS, &r);
    std::printf("segments %u\nsteps %u\n", r.segments, r.newton_steps);
    end("track");
}
