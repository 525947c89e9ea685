// Hipparchus 4.0.3 (its jars come with the Python package orekit-jpype 13.1.9.0). The solver's name
// is the argument, with the number of steps behind those of Adams: AdamsBashforth4.
import java.util.ArrayList;
import java.util.List;
import org.hipparchus.analysis.solvers.BracketingNthOrderBrentSolver;
import org.hipparchus.ode.DenseOutputModel;
import org.hipparchus.ode.ODEIntegrator;
import org.hipparchus.ode.ODEState;
import org.hipparchus.ode.ODEStateAndDerivative;
import org.hipparchus.ode.OrdinaryDifferentialEquation;
import org.hipparchus.ode.events.AbstractODEDetector;
import org.hipparchus.ode.events.Action;
import org.hipparchus.ode.events.AdaptableInterval;
import org.hipparchus.ode.events.ODEEventHandler;
import org.hipparchus.ode.nonstiff.AdamsBashforthIntegrator;
import org.hipparchus.ode.nonstiff.AdamsMoultonIntegrator;
import org.hipparchus.ode.nonstiff.DormandPrince54Integrator;
import org.hipparchus.ode.nonstiff.DormandPrince853Integrator;
import org.hipparchus.ode.nonstiff.GraggBulirschStoerIntegrator;
import org.hipparchus.ode.nonstiff.HighamHall54Integrator;

final class Hipparchus implements Protocol.Solver {
    private final String name;

    private Hipparchus(String name) {
        this.name = name;
    }

    public static void main(String[] arguments) throws Exception {
        Protocol.serve(arguments[0], new Hipparchus(arguments[0]));
    }

    /** The steps may be as long as the run, and as short as 10⁻¹² of it. */
    private ODEIntegrator integrator(Protocol.Run run) {
        double longest = Math.abs(run.end() - run.grid[0]), shortest = 1e-12 * longest;
        int steps = name.startsWith("Adams") ? name.charAt(name.length() - 1) - '0' : 0;
        switch (steps > 0 ? name.substring(0, name.length() - 1) : name) {
            case "HighamHall54": return new HighamHall54Integrator(shortest, longest, run.each, both(run.tol));
            case "DormandPrince54": return new DormandPrince54Integrator(shortest, longest, run.each, both(run.tol));
            case "DormandPrince853": return new DormandPrince853Integrator(shortest, longest, run.each, both(run.tol));
            case "GraggBulirschStoer": return new GraggBulirschStoerIntegrator(shortest, longest, run.each, both(run.tol));
            case "AdamsBashforth": return new AdamsBashforthIntegrator(steps, shortest, longest, run.each, both(run.tol));
            case "AdamsMoulton": return new AdamsMoultonIntegrator(steps, shortest, longest, run.each, both(run.tol));
            default: throw new IllegalArgumentException("no such integrator");
        }
    }

    private static double[] both(double x) {
        return new double[] {x, x};
    }

    private static ODEStateAndDerivative integrate(Protocol.Run run, ODEIntegrator integrator) {
        OrdinaryDifferentialEquation equation = new OrdinaryDifferentialEquation() {
            @Override
            public int getDimension() {
                return 2;
            }

            @Override
            public double[] computeDerivatives(double t, double[] y) {
                return run.rate(t, y);
            }
        };
        return integrator.integrate(equation, new ODEState(run.grid[0], run.start.clone()), run.end());
    }

    /** The last time is the end of the last step; those before are interpolated. */
    @Override
    public double[][] solve(Protocol.Run run) {
        ODEIntegrator integrator = integrator(run);
        DenseOutputModel dense = new DenseOutputModel();
        if (run.grid.length > 2) integrator.addStepHandler(dense);
        double[][] states = new double[run.grid.length - 1][];
        states[states.length - 1] = integrate(run, integrator).getPrimaryState();
        for (int i = 0; i < states.length - 1; i++)
            states[i] = dense.getInterpolatedState(run.grid[i + 1]).getPrimaryState();
        return states;
    }

    /** theta, looked at four times in the time of a radian of small swings, and its zeros as exactly as the run. */
    private static final class Zero extends AbstractODEDetector<Zero> {
        Zero(AdaptableInterval interval, int most, BracketingNthOrderBrentSolver solver, ODEEventHandler handler) {
            super(interval, most, solver, handler);
        }

        @Override
        public double g(ODEStateAndDerivative state) {
            return state.getPrimaryState()[0];
        }

        @Override
        protected Zero create(AdaptableInterval interval, int most,
                org.hipparchus.analysis.solvers.BracketedUnivariateSolver<org.hipparchus.analysis.UnivariateFunction> solver,
                ODEEventHandler handler) {
            throw new UnsupportedOperationException();
        }
    }

    @Override
    public double[][] crossings(Protocol.Run run) {
        double second = 1 / Math.sqrt(run.g);
        List<double[]> found = new ArrayList<>();
        ODEEventHandler handler = (state, detector, increasing) -> {
            double[] y = state.getPrimaryState();
            found.add(new double[] {state.getTime(), y[0], y[1]});
            return Action.CONTINUE;
        };
        ODEIntegrator integrator = integrator(run);
        integrator.addEventDetector(new Zero(AdaptableInterval.of(0.25 * second), 100,
                new BracketingNthOrderBrentSolver(0, run.tol * second, 0, 5), handler));
        integrate(run, integrator);
        return found.toArray(new double[0][]);
    }
}
