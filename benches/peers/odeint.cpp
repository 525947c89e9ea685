// Boost.odeint on one scene: each stepper on a ladder of steps or tolerances.
//
// Arguments: the release angle (rad), the whole number of seconds to run, and the angle (rad) and
// angular velocity (rad/s) of the exact motion there. A line for each setting: the stepper, the
// error max(|dtheta|, |domega|/omega_0) at the end, the shortest CPU time (s). others.py reads it.

#include <boost/numeric/odeint.hpp>
#include <boost/numeric/odeint/stepper/symplectic_rkn_sb3a_m4_mclachlan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <utility>
#include <vector>

namespace odeint = boost::numeric::odeint;

using State = std::array<double, 2>;
using Number = std::array<double, 1>;

constexpr double GRAVITY = 9.81;  // L = 1
// The longest run (s) after which a finer setting is still tried.
constexpr double PATIENCE = 0.1;
constexpr int RUNS = 7;

struct Equations {
    void operator()(const State &z, State &rate, double) const {
        rate[0] = z[1];
        rate[1] = -GRAVITY * std::sin(z[0]);
    }
};

// The same for symplectic steppers: the rate of the momentum.
struct Force {
    void operator()(const Number &theta, Number &rate) const {
        rate[0] = -GRAVITY * std::sin(theta[0]);
    }
};

struct Scene {
    double theta_0;
    long end;
    State exact;
};

double cpu_seconds() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

// Prints a line, and says whether a finer setting is worth trying.
template <class Run>
bool measure(const char *name, const Scene &scene, Run run) {
    State end{};
    double shortest = INFINITY;
    for (int i = 0; i < RUNS; ++i) {
        volatile double theta_0 = scene.theta_0;
        const double begun = cpu_seconds();
        end = run(State{theta_0, 0.0});
        shortest = std::fmin(shortest, cpu_seconds() - begun);
        if (shortest > PATIENCE) break;
    }
    const double error = std::fmax(std::fabs(end[0] - scene.exact[0]),
                                   std::fabs(end[1] - scene.exact[1]) / std::sqrt(GRAVITY));
    std::printf("%s %.17g %.9g\n", name, error, shortest);
    return shortest < PATIENCE && !(error < 1e-13);
}

// All steps that are exact and end exactly at the end, the longest first: d/2^k s, d odd.
std::vector<long> counts(long end) {
    std::vector<long> all;
    for (long d = 1; d <= end; d += 2) {
        if (end % d != 0) continue;
        for (int k = 1; k <= 16; ++k) {
            const long count = (end / d) << k;
            if (2 * end <= count) all.push_back(count);
        }
    }
    std::sort(all.begin(), all.end());
    return all;
}

template <class Stepper>
void fixed(const char *name, const Scene &scene) {
    for (const long count : counts(scene.end)) {
        const bool more = measure(name, scene, [&](State z) {
            Stepper stepper;
            const double h = double(scene.end) / count;
            odeint::integrate_n_steps(stepper, Equations{}, z, 0.0, h, count);
            return z;
        });
        if (!more) break;
    }
}

template <class Stepper>
void symplectic(const char *name, const Scene &scene) {
    for (const long count : counts(scene.end)) {
        const bool more = measure(name, scene, [&](State z) {
            Stepper stepper;
            auto state = std::make_pair(Number{z[0]}, Number{z[1]});
            const double h = double(scene.end) / count;
            odeint::integrate_n_steps(stepper, Force{}, state, 0.0, h, count);
            return State{state.first[0], state.second[0]};
        });
        if (!more) break;
    }
}

template <class Make>
void controlled(const char *name, const Scene &scene, Make make) {
    for (int quarters = 4; quarters <= 60; ++quarters) {
        const double tolerance = std::pow(10.0, -0.25 * quarters);
        const bool more = measure(name, scene, [&](State z) {
            auto stepper = make(tolerance);
            odeint::integrate_adaptive(stepper, Equations{}, z, 0.0, double(scene.end), 0.01);
            return z;
        });
        if (!more) break;
    }
}

int main(int count, char **words) {
    if (count != 5) {
        std::fprintf(stderr, "odeint: an angle, a duration, and the exact angle and velocity\n");
        return 2;
    }
    const Scene scene{std::atof(words[1]), std::atol(words[2]),
                      {std::atof(words[3]), std::atof(words[4])}};
    fixed<odeint::runge_kutta4<State>>("runge_kutta4", scene);
    symplectic<odeint::symplectic_rkn_sb3a_mclachlan<Number>>("sb3a_mclachlan", scene);
    symplectic<odeint::symplectic_rkn_sb3a_m4_mclachlan<Number>>("sb3a_m4_mclachlan", scene);
    controlled("dopri5", scene, [](double tolerance) {
        return odeint::make_controlled<odeint::runge_kutta_dopri5<State>>(tolerance, tolerance);
    });
    controlled("fehlberg78", scene, [](double tolerance) {
        return odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(tolerance, tolerance);
    });
    controlled("bulirsch_stoer", scene, [](double tolerance) {
        return odeint::bulirsch_stoer<State>(tolerance, tolerance);
    });
}
