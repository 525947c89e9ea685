// Boost.odeint: x' = -x, x(0) = 1, to t = 2, begun by itself and by a method of order 8.
#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>
#include <cmath>
#include <cstdio>
using namespace boost::numeric::odeint;
using State = std::vector<double>;
int main() {
    std::printf("Boost %s\n", BOOST_LIB_VERSION);
    auto rate = [](const State &x, State &dx, double) { dx[0] = -x[0]; };
    for (bool given : {false, true})
        for (int n : {20, 40, 80}) {
            adams_bashforth_moulton<8, State> stepper;
            State x{1};
            double t = 0, h = 2.0 / n;
            if (given) stepper.initialize(runge_kutta_fehlberg78<State>(), rate, x, t, h);
            for (int i = std::lround(t / h); i < n; i++) stepper.do_step(rate, x, i * h, h);
            std::printf("order() = %d, begun by %s, %d steps: error %.1e\n", stepper.order(),
                        given ? "Fehlberg's 8" : "itself", n, std::abs(x[0] - std::exp(-2.0)));
        }
}
