// Boost.odeint: x' = cos t, x(0) = 0, so x(1) = sin 1, by rosenbrock4 as it is and with -d4.
#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>
#include <cmath>
#include <cstdio>
using namespace boost::numeric::odeint;
using V = boost::numeric::ublas::vector<double>;
using M = boost::numeric::ublas::matrix<double>;
struct Mended : default_rosenbrock_coefficients<double> { const double d4 = -0.0362; };
template <class Stepper> void solve(const char *name) {
    auto rate = [](const V &, V &dx, double t) { dx[0] = std::cos(t); };
    auto slope = [](const V &, M &j, double t, V &dfdt) { j(0, 0) = 0, dfdt[0] = -std::sin(t); };
    for (int n : {10, 20, 40}) {
        Stepper stepper;
        V x(1, 0.0);
        double h = 1.0 / n;
        for (int i = 0; i < n; i++) stepper.do_step(std::make_pair(rate, slope), x, i * h, h);
        std::printf("%s, %d steps: x(1) = %.9f, right %.9f\n", name, n, x[0], std::sin(1.0));
    }
}
int main() {
    std::printf("Boost %s\n", BOOST_LIB_VERSION);
    solve<rosenbrock4<double>>("rosenbrock4");
    solve<rosenbrock4<double, Mended>>("with d4 = -0.0362");
}
