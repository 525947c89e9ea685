// Boost.odeint 1.74.0 (Debian: libboost-dev 1.74.0.3). The integrator's name is the argument.
// The claims are in ../strangers.toml; each stands in
// boost/numeric/odeint/stepper/NAME.hpp, and in order_value or stepper_order.
#include "protocol.h"

#include <boost/numeric/odeint.hpp>
#include <boost/numeric/odeint/stepper/symplectic_rkn_sb3a_m4_mclachlan.hpp>
#include <boost/numeric/odeint/stepper/velocity_verlet.hpp>

#include <functional>
#include <map>
#include <string>

namespace ode = boost::numeric::odeint;
namespace ublas = boost::numeric::ublas;

using state = boost::array<double, 2>;
using number = boost::array<double, 1>;
using vector = ublas::vector<double>;
using matrix = ublas::matrix<double>;

struct request {
    pendulum *p;
    double theta, omega, h;
    long n, k;
    path *out;
};

// y' = f(y, t), the whole state at once.
template <class Stepper> void first_order(const request &r) {
    Stepper stepper;
    state y = {{r.theta, r.omega}};
    auto f = [&](const state &y, state &dy, double t) {
        dy[0] = y[1];
        dy[1] = force(r.p, y[0], t);
    };
    for (long i = 0; i < r.n; i++) {
        stepper.do_step(f, y, i * r.h, r.h);
        if ((i + 1) % r.k == 0) keep(r.out, y[0], y[1]);
    }
}

// The same, from one state into another.
template <class Stepper> void out_of_place(const request &r) {
    Stepper stepper;
    state y = {{r.theta, r.omega}}, next;
    auto f = [&](const state &y, state &dy, double t) {
        dy[0] = y[1];
        dy[1] = force(r.p, y[0], t);
    };
    for (long i = 0; i < r.n; i++) {
        stepper.do_step(f, y, i * r.h, next, r.h);
        y = next;
        if ((i + 1) % r.k == 0) keep(r.out, y[0], y[1]);
    }
}

// q' = p, p' = f(q): the time is not passed on, so nothing can drive it.
template <class Stepper> void symplectic(const request &r) {
    Stepper stepper;
    std::pair<number, number> y{{{r.theta}}, {{r.omega}}};
    auto f = [&](const number &q, number &dp) { dp[0] = force(r.p, q[0], 0.0); };
    for (long i = 0; i < r.n; i++) {
        stepper.do_step(f, y, i * r.h, r.h);
        if ((i + 1) % r.k == 0) keep(r.out, y.first[0], y.second[0]);
    }
}

// a = f(q, v, t).
void verlet(const request &r) {
    ode::velocity_verlet<number> stepper;
    std::pair<number, number> y{{{r.theta}}, {{r.omega}}};
    auto f = [&](const number &q, const number &, number &a, double t) { a[0] = force(r.p, q[0], t); };
    for (long i = 0; i < r.n; i++) {
        stepper.do_step(f, y, i * r.h, r.h);
        if ((i + 1) % r.k == 0) keep(r.out, y.first[0], y.second[0]);
    }
}

void right_hand_side(const request &r, const vector &y, vector &dy, double t) {
    dy[0] = y[1];
    dy[1] = force(r.p, y[0], t);
}

void jacobian(const request &r, const vector &y, matrix &j) {
    j(0, 0) = 0.0;
    j(0, 1) = 1.0;
    j(1, 0) = -r.p->gl * std::cos(y[0]);
    j(1, 1) = 0.0;
}

template <class Stepper, class System> void ublas_steps(const request &r, Stepper stepper, System system) {
    vector y(2);
    y[0] = r.theta;
    y[1] = r.omega;
    for (long i = 0; i < r.n; i++) {
        stepper.do_step(system, y, i * r.h, r.h);
        if ((i + 1) % r.k == 0) keep(r.out, y[0], y[1]);
    }
}

void implicit_euler(const request &r) {
    auto f = [&](const vector &y, vector &dy, double t) { right_hand_side(r, y, dy, t); };
    auto j = [&](const vector &y, matrix &m, double) { jacobian(r, y, m); };
    ublas_steps(r, ode::implicit_euler<double>(), std::make_pair(f, j));
}

void rosenbrock4(const request &r) {
    auto f = [&](const vector &y, vector &dy, double t) { right_hand_side(r, y, dy, t); };
    auto j = [&](const vector &y, matrix &m, double t, vector &dfdt) {
        jacobian(r, y, m);
        dfdt[0] = 0.0;
        dfdt[1] = -r.p->a * r.p->w * std::sin(r.p->w * t);
    };
    ublas_steps(r, ode::rosenbrock4<double>(), std::make_pair(f, j));
}

struct entry {
    std::function<void(const request &)> run;
    bool drives;
};

static const std::map<std::string, entry> integrators = {
    {"euler", {first_order<ode::euler<state>>, true}},
    {"modified_midpoint", {first_order<ode::modified_midpoint<state>>, true}},
    {"runge_kutta4", {first_order<ode::runge_kutta4<state>>, true}},
    {"runge_kutta4_classic", {first_order<ode::runge_kutta4_classic<state>>, true}},
    {"runge_kutta_cash_karp54", {first_order<ode::runge_kutta_cash_karp54<state>>, true}},
    {"runge_kutta_cash_karp54_classic", {first_order<ode::runge_kutta_cash_karp54_classic<state>>, true}},
    {"runge_kutta_dopri5", {first_order<ode::runge_kutta_dopri5<state>>, true}},
    {"runge_kutta_fehlberg78", {first_order<ode::runge_kutta_fehlberg78<state>>, true}},
    {"extrapolation_stepper<4>", {first_order<ode::extrapolation_stepper<4, state>>, true}},
    {"extrapolation_stepper<4>/out-of-place", {out_of_place<ode::extrapolation_stepper<4, state>>, true}},
    {"extrapolation_stepper<6>", {first_order<ode::extrapolation_stepper<6, state>>, true}},
    {"extrapolation_stepper<6>/out-of-place", {out_of_place<ode::extrapolation_stepper<6, state>>, true}},
    {"extrapolation_stepper<8>", {first_order<ode::extrapolation_stepper<8, state>>, true}},
    {"extrapolation_stepper<8>/out-of-place", {out_of_place<ode::extrapolation_stepper<8, state>>, true}},
    {"adams_bashforth<1>", {first_order<ode::adams_bashforth<1, state>>, true}},
    {"adams_bashforth<2>", {first_order<ode::adams_bashforth<2, state>>, true}},
    {"adams_bashforth<2>/out-of-place", {out_of_place<ode::adams_bashforth<2, state>>, true}},
    {"adams_bashforth<3>", {first_order<ode::adams_bashforth<3, state>>, true}},
    {"adams_bashforth<3>/out-of-place", {out_of_place<ode::adams_bashforth<3, state>>, true}},
    {"adams_bashforth<4>", {first_order<ode::adams_bashforth<4, state>>, true}},
    {"adams_bashforth<4>/out-of-place", {out_of_place<ode::adams_bashforth<4, state>>, true}},
    {"adams_bashforth<5>", {first_order<ode::adams_bashforth<5, state>>, true}},
    {"adams_bashforth<5>/out-of-place", {out_of_place<ode::adams_bashforth<5, state>>, true}},
    {"adams_bashforth<6>", {first_order<ode::adams_bashforth<6, state>>, true}},
    {"adams_bashforth<6>/out-of-place", {out_of_place<ode::adams_bashforth<6, state>>, true}},
    {"adams_bashforth<7>", {first_order<ode::adams_bashforth<7, state>>, true}},
    {"adams_bashforth<7>/out-of-place", {out_of_place<ode::adams_bashforth<7, state>>, true}},
    {"adams_bashforth<8>", {first_order<ode::adams_bashforth<8, state>>, true}},
    {"adams_bashforth<8>/out-of-place", {out_of_place<ode::adams_bashforth<8, state>>, true}},
    {"adams_bashforth_moulton<1>", {first_order<ode::adams_bashforth_moulton<1, state>>, true}},
    {"adams_bashforth_moulton<2>", {first_order<ode::adams_bashforth_moulton<2, state>>, true}},
    {"adams_bashforth_moulton<3>", {first_order<ode::adams_bashforth_moulton<3, state>>, true}},
    {"adams_bashforth_moulton<4>", {first_order<ode::adams_bashforth_moulton<4, state>>, true}},
    {"adams_bashforth_moulton<5>", {first_order<ode::adams_bashforth_moulton<5, state>>, true}},
    {"adams_bashforth_moulton<6>", {first_order<ode::adams_bashforth_moulton<6, state>>, true}},
    {"adams_bashforth_moulton<7>", {first_order<ode::adams_bashforth_moulton<7, state>>, true}},
    {"adams_bashforth_moulton<8>", {first_order<ode::adams_bashforth_moulton<8, state>>, true}},
    {"symplectic_euler", {symplectic<ode::symplectic_euler<number>>, false}},
    {"symplectic_rkn_sb3a_mclachlan", {symplectic<ode::symplectic_rkn_sb3a_mclachlan<number>>, false}},
    {"symplectic_rkn_sb3a_m4_mclachlan", {symplectic<ode::symplectic_rkn_sb3a_m4_mclachlan<number>>, false}},
    {"velocity_verlet", {verlet, true}},
    {"implicit_euler", {implicit_euler, true}},
    {"rosenbrock4", {rosenbrock4, true}},
};

static const char *integrate(const char *name, pendulum *p, double theta, double omega, double h, long n,
                             long k, path *out) {
    integrators.at(name).run({p, theta, omega, h, n, k, out});
    return nullptr;
}

int main(int argc, char **argv) {
    auto found = integrators.find(argc > 1 ? argv[1] : "");
    if (found == integrators.end()) {
        for (auto &known : integrators) std::printf("%s\n", known.first.c_str());
        return 2;
    }
    return serve(argv[1], integrate, found->second.drives);
}
