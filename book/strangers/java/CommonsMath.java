// Apache Commons Math 3.6.1 (Debian: libcommons-math3-java 3.6.1-3). The solver's name is the
// argument, with the number of steps behind those of Adams: AdamsBashforth4.
import java.util.ArrayList;
import java.util.List;
import org.apache.commons.math3.ode.ContinuousOutputModel;
import org.apache.commons.math3.ode.FirstOrderDifferentialEquations;
import org.apache.commons.math3.ode.FirstOrderIntegrator;
import org.apache.commons.math3.ode.events.EventHandler;
import org.apache.commons.math3.ode.nonstiff.AdamsBashforthIntegrator;
import org.apache.commons.math3.ode.nonstiff.AdamsMoultonIntegrator;
import org.apache.commons.math3.ode.nonstiff.DormandPrince54Integrator;
import org.apache.commons.math3.ode.nonstiff.DormandPrince853Integrator;
import org.apache.commons.math3.ode.nonstiff.GraggBulirschStoerIntegrator;
import org.apache.commons.math3.ode.nonstiff.HighamHall54Integrator;

final class CommonsMath implements Protocol.Solver {
    private final String name;

    private CommonsMath(String name) {
        this.name = name;
    }

    public static void main(String[] arguments) throws Exception {
        Protocol.serve(arguments[0], new CommonsMath(arguments[0]));
    }

    /** The steps may be as long as the run, and as short as 10⁻¹² of it. */
    private FirstOrderIntegrator integrator(Protocol.Run run) {
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

    private static double[] integrate(Protocol.Run run, FirstOrderIntegrator integrator) {
        FirstOrderDifferentialEquations equations = new FirstOrderDifferentialEquations() {
            @Override
            public int getDimension() {
                return 2;
            }

            @Override
            public void computeDerivatives(double t, double[] y, double[] dy) {
                System.arraycopy(run.rate(t, y), 0, dy, 0, 2);
            }
        };
        double[] end = new double[2];
        double until = integrator.integrate(equations, run.grid[0], run.start, run.end(), end);
        if (until != run.end()) throw new IllegalStateException("it ended at " + until);
        return end;
    }

    /** The last time is the end of the last step; those before are interpolated. */
    @Override
    public double[][] solve(Protocol.Run run) {
        FirstOrderIntegrator integrator = integrator(run);
        ContinuousOutputModel dense = new ContinuousOutputModel();
        if (run.grid.length > 2) integrator.addStepHandler(dense);
        double[][] states = new double[run.grid.length - 1][];
        states[states.length - 1] = integrate(run, integrator);
        for (int i = 0; i < states.length - 1; i++) {
            dense.setInterpolatedTime(run.grid[i + 1]);
            states[i] = dense.getInterpolatedState().clone();
        }
        return states;
    }

    /** theta, looked at four times in the time of a radian of small swings, and its zeros as exactly as the run. */
    @Override
    public double[][] crossings(Protocol.Run run) {
        List<double[]> found = new ArrayList<>();
        EventHandler handler = new EventHandler() {
            @Override
            public void init(double t0, double[] y0, double t) {}

            @Override
            public double g(double t, double[] y) {
                return y[0];
            }

            @Override
            public Action eventOccurred(double t, double[] y, boolean increasing) {
                found.add(new double[] {t, y[0], y[1]});
                return Action.CONTINUE;
            }

            @Override
            public void resetState(double t, double[] y) {}
        };
        double second = 1 / Math.sqrt(run.g);
        FirstOrderIntegrator integrator = integrator(run);
        integrator.addEventHandler(handler, 0.25 * second, run.tol * second, 100);
        integrate(run, integrator);
        return found.toArray(new double[0][]);
    }
}
