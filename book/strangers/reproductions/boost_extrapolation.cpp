// Boost.odeint: x' = -x, x(0) = 1, to t = 1: a step into another state, and the same in place.
#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>
#include <cmath>
#include <cstdio>
using namespace boost::numeric::odeint;
using State = std::vector<double>;
template <class Stepper> void solve(const char *name) {
    auto rate = [](const State &x, State &dx, double) { dx[0] = -x[0]; };
    for (int n : {10, 20, 40}) {
        Stepper one, other;
        State in_place{1}, from{1}, to{1};
        for (int i = 0; i < n; i++, from = to) {
            one.do_step(rate, in_place, double(i) / n, 1.0 / n);
            other.do_step(rate, from, double(i) / n, to, 1.0 / n);
        }
        std::printf("%s, %d steps: %.9f in place, %.9f else\n", name, n, in_place[0], to[0]);
    }
}
int main() {
    std::printf("Boost %s; right: %.9f\n", BOOST_LIB_VERSION, std::exp(-1.0));
    solve<extrapolation_stepper<4, State>>("extrapolation_stepper<4>");
    solve<adams_bashforth<4, State>>("adams_bashforth<4>");
}
