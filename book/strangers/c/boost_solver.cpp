// Boost.odeint 1.81.0 (Debian: libboost1.81-dev 1.81.0-5+deb12u1), integrate_adaptive to a single
// time and integrate_times to several. The solver's name is the argument: a stepper, with /dense
// behind it where it interpolates. Otherwise steps end at the times asked for. It looks for no events.
#include "solver.h"

#include <boost/numeric/odeint.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ode = boost::numeric::odeint;
namespace ublas = boost::numeric::ublas;

using state = boost::array<double, 2>;
using vector = ublas::vector<double>;
using matrix = ublas::matrix<double>;
using states_t = double (*)[2];

// The first step is a thousandth of the time of a radian of small swings.
template <class Stepper, class System, class State>
void integrate(Stepper stepper, System system, State y, const run &r, states_t states) {
    const double *end = r.grid + r.n;
    const double first = std::copysign(1e-3 / std::sqrt(r.g), *end - r.t0);
    if (r.n == 1) {
        ode::integrate_adaptive(stepper, system, y, r.t0, *end, first);
        states[0][0] = y[0];
        states[0][1] = y[1];
        return;
    }
    long at = -1; // The first time is the start.
    ode::integrate_times(stepper, system, y, r.grid, end + 1, first, [&](const State &y, double) {
        if (at >= 0) {
            states[at][0] = y[0];
            states[at][1] = y[1];
        }
        at++;
    });
}

template <class Stepper> void explicit_steps(Stepper stepper, run &r, states_t states) {
    auto system = [&](const state &y, state &dy, double t) { rate(&r, t, y.data(), dy.data()); };
    integrate(stepper, system, state{{r.start[0], r.start[1]}}, r, states);
}

template <class Stepper> void controlled(run &r, states_t states) {
    explicit_steps(ode::make_controlled(r.tol, r.tol, Stepper()), r, states);
}

template <class Stepper> void dense(run &r, states_t states) {
    explicit_steps(ode::make_dense_output(r.tol, r.tol, Stepper()), r, states);
}

template <class Stepper> void by_itself(run &r, states_t states) {
    explicit_steps(Stepper(r.tol, r.tol), r, states);
}

template <class Stepper> void implicit_steps(Stepper stepper, run &r, states_t states) {
    auto f = [&](const vector &y, vector &dy, double t) { rate(&r, t, &y[0], &dy[0]); };
    auto j = [&](const vector &y, matrix &m, double t, vector &dfdt) {
        m(0, 0) = 0.0;
        m(0, 1) = 1.0;
        m(1, 0) = -r.g * std::cos(y[0]);
        m(1, 1) = 0.0;
        dfdt[0] = 0.0;
        dfdt[1] = -r.a * r.w * std::sin(r.w * t);
    };
    vector y(2);
    y[0] = r.start[0];
    y[1] = r.start[1];
    integrate(stepper, std::make_pair(f, j), y, r, states);
}

using rosenbrock = ode::rosenbrock4<double>;

// Its error_checker takes the tolerances like that of make_controlled.
template <int Steps> void adams(run &r, states_t states) {
    using stepper = ode::adaptive_adams_bashforth_moulton<Steps, state>;
    explicit_steps(ode::make_controlled(r.tol, r.tol, stepper()), r, states);
}

static const std::map<std::string, std::function<void(run &, states_t)>> solvers = {
    {"runge_kutta_cash_karp54", controlled<ode::runge_kutta_cash_karp54<state>>},
    {"runge_kutta_cash_karp54_classic", controlled<ode::runge_kutta_cash_karp54_classic<state>>},
    {"runge_kutta_fehlberg78", controlled<ode::runge_kutta_fehlberg78<state>>},
    {"runge_kutta_dopri5", controlled<ode::runge_kutta_dopri5<state>>},
    {"runge_kutta_dopri5/dense", dense<ode::runge_kutta_dopri5<state>>},
    {"bulirsch_stoer", by_itself<ode::bulirsch_stoer<state>>},
    {"bulirsch_stoer_dense_out", by_itself<ode::bulirsch_stoer_dense_out<state>>},
    {"adaptive_adams_bashforth_moulton<4>", adams<4>},
    {"rosenbrock4",
     [](run &r, states_t states) {
         implicit_steps(ode::make_controlled(r.tol, r.tol, rosenbrock()), r, states);
     }},
    {"rosenbrock4/dense",
     [](run &r, states_t states) {
         implicit_steps(ode::make_dense_output(r.tol, r.tol, rosenbrock()), r, states);
     }},
};

static const char *solve(const char *name, run *r, states_t states) {
    static std::string why;
    try {
        solvers.at(name)(*r, states);
        return nullptr;
    } catch (const std::exception &error) {
        why = error.what();
        for (char &c : why)
            if (c == '\n') c = ' ';
        return why.c_str();
    }
}

int main(int argc, char **argv) {
    if (argc < 2 || !solvers.count(argv[1])) {
        for (auto &known : solvers) std::printf("%s\n", known.first.c_str());
        return 2;
    }
    return serve(argv[1], solve);
}
