// The part of a ROS 2 node that computes: lengths of the legs in, the pose of the platform out. No ROS header is included; comments say where a node would call.
//
//     c++ -std=c++17 pose_estimator.cpp $(pkg-config --cflags --libs equipod) -o pose_estimator && ./pose_estimator designs/presets/bench-l16.toml
#include <eqp.h>

#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

void must(eqp_status status, const eqp_error &error)
{
    if (status != EQP_STATUS_OK) {
        throw std::runtime_error(std::string(eqp_status_text(status)) + ": " + error.message);
    }
}

// Handles that free themselves.
template <auto Free> struct Freed {
    template <typename T> void operator()(T *pointer) const { Free(pointer); }
};
using Design = std::unique_ptr<eqp_design, Freed<eqp_design_free>>;
using Solver = std::unique_ptr<eqp_solver, Freed<eqp_solver_free>>;
using Solutions = std::unique_ptr<eqp_solutions, Freed<eqp_solutions_free>>;
using Tracker = std::unique_ptr<eqp_tracker, Freed<eqp_tracker_free>>;

Design load(const std::string &path)
{
    eqp_design *design = nullptr;
    eqp_error error;
    must(eqp_design_load(path.c_str(), &design, &error), error);
    return Design(design);
}

// A node would own one of these: made in its constructor from the parameter `design_file`, asked in the callback of the topic `joint_states`.
class PoseEstimator {
public:
    explicit PoseEstimator(const std::string &path) : design_(load(path))
    {
        eqp_error error;
        eqp_pose home;
        must(eqp_design_home(design_.get(), &home, &error), error);
        eqp_tracker *tracker = nullptr;
        must(eqp_tracker_new(design_.get(), &home, &tracker, &error), error);
        tracker_.reset(tracker);
    }

    // In the callback: `lengths` are the six positions of sensor_msgs/msg/JointState. What is returned fills geometry_msgs/msg/PoseStamped, or a
    // transform from the frame of the base to that of the platform; false becomes an error of diagnostic_msgs and no pose is published.
    bool update(const std::array<double, 6> &lengths, eqp_pose &pose)
    {
        eqp_error error;
        eqp_track track;
        must(eqp_tracker_step(tracker_.get(), lengths.data(), &track, &error), error);
        pose = track.pose;
        return track.status == EQP_TRACK_STATUS_TRACKED;
    }

    const eqp_design *design() const { return design_.get(); }

private:
    Design design_;
    Tracker tracker_;
};

} // namespace

int main(int count, char **arguments)
try {
    if (count != 2) {
        std::cerr << "usage: " << arguments[0] << " DESIGN\n";
        return 2;
    }
    PoseEstimator estimator(arguments[1]);
    eqp_error error;
    eqp_pose pose;
    must(eqp_design_home(estimator.design(), &pose, &error), error);
    double worst = 0;
    for (int k = 1; k <= 100; k++) {
        eqp_pose truth = pose, found;
        truth.position[0] += 0.02 * k;
        std::array<double, 6> lengths;
        must(eqp_ik(estimator.design(), &truth, 1, lengths.data(), &error), error);
        if (!estimator.update(lengths, found)) {
            std::cerr << "not tracked\n";
            return 1;
        }
        worst = std::max(worst, std::abs(found.position[0] - truth.position[0]));
    }

    // threads share a design and a solver
    eqp_solver *made = nullptr;
    must(eqp_solver_new(estimator.design(), 1, &made, &error), error);
    const Solver solver(made);
    std::vector<std::array<double, 6>> rows(4);
    must(eqp_ik(estimator.design(), &pose, 1, rows[0].data(), &error), error);
    for (std::size_t k = 1; k < rows.size(); k++) {
        rows[k] = rows[0];
        rows[k][0] += 0.1 * static_cast<double>(k);
    }
    std::vector<std::size_t> counts(rows.size(), 0);
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < rows.size(); k++) {
        threads.emplace_back([&, k] {
            eqp_solutions *solutions = nullptr;
            if (eqp_solve(solver.get(), rows[k].data(), &solutions, nullptr) == EQP_STATUS_OK) {
                counts[k] = eqp_solutions_count(Solutions(solutions).get());
            }
        });
    }
    for (std::thread &thread : threads) {
        thread.join();
    }
    // a batch has the same answers
    std::vector<eqp_solutions *> batch(rows.size());
    must(eqp_solve_all(solver.get(), rows[0].data(), rows.size(), 2, batch.data(), nullptr, &error), error);
    bool same = true;
    for (std::size_t k = 0; k < rows.size(); k++) {
        same = same && eqp_solutions_count(batch[k]) == counts[k] && counts[k] > 0;
        eqp_solutions_free(batch[k]);
    }
    std::cout << "100 steps tracked, greatest error " << worst << "; " << rows.size() << " rows solved by threads and as a batch "
              << (same ? "alike" : "differently") << '\n';
    return worst < 1e-6 && same ? 0 : 1;
} catch (const std::exception &failure) {
    std::cerr << failure.what() << '\n';
    return 1;
}
