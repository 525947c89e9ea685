import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/** The judge's text protocol, version 1, for solvers that choose their steps: one solver a program. */
final class Protocol {
    private Protocol() {}

    /** What a library does with one request. */
    interface Solver {
        /** theta and omega at the times of the grid after its first, which is the start. */
        double[][] solve(Run run) throws Exception;

        /** t, theta and omega where theta passes zero; null where the library looks for no events. */
        default double[][] crossings(Run run) throws Exception {
            return null;
        }
    }

    /** One request: theta'' = -g sin theta + a cos(w t), from the first time of the grid on, or back. */
    static final class Run {
        final double g, a, w, tol;
        final double[] start;
        /** The tolerance of theta and of omega, for a library that takes two. */
        final double[] each;
        /** Where the run begins, and then each of the times once. */
        final double[] grid;
        private final double[] asked;
        private long count = 0;

        Run(String[] words) {
            double[] x = Arrays.stream(words).skip(1).mapToDouble(Run::number).toArray();
            boolean driven = words[0].equals("driven-solve"), events = words[0].equals("crossings");
            int k = driven ? 3 : 1;
            if (x.length < k + 5) throw new IllegalArgumentException("numbers are missing");
            g = x[0];
            a = driven ? x[1] : 0;
            w = driven ? x[2] : 0;
            start = new double[] {x[k], x[k + 1]};
            double t0 = x[k + 2];
            tol = events ? x[k + 4] : x[k + 3];
            asked = events ? new double[] {x[k + 3]} : Arrays.copyOfRange(x, k + 4, x.length);
            each = new double[] {tol, tol * Math.sqrt(Math.abs(g))};
            double[] all = new double[asked.length + 1];
            int n = 0;
            all[n++] = t0;
            for (double t : asked) if (t != all[n - 1]) all[n++] = t;
            grid = Arrays.copyOf(all, n);
            // A library that hangs with these, or takes them for others, is not asked.
            for (double t : grid) if (!Double.isFinite(t)) throw new IllegalArgumentException("a time is not finite");
            for (int i = 2; i < n; i++)
                if (grid[i] > grid[i - 1] != grid[1] > grid[0]) throw new IllegalArgumentException("the times turn round");
        }

        private static double number(String word) {
            switch (word.toLowerCase()) {
                case "inf": return Double.POSITIVE_INFINITY;
                case "-inf": return Double.NEGATIVE_INFINITY;
                case "nan": return Double.NaN;
                default: return Double.parseDouble(word);
            }
        }

        double end() {
            return grid[grid.length - 1];
        }

        /** The derivatives of angle and velocity, counted. */
        double[] rate(double t, double[] y) {
            count++;
            return new double[] {y[1], a * Math.cos(w * t) - g * Math.sin(y[0])};
        }
    }

    /** Answers requests until `bye`. */
    static void serve(String name, Solver solver) throws Exception {
        PrintStream out = new PrintStream(System.out, false);
        System.setOut(System.err);
        BufferedReader in = new BufferedReader(new InputStreamReader(System.in));
        for (String line = in.readLine(); line != null && !line.equals("bye"); line = in.readLine()) {
            StringBuilder text = new StringBuilder();
            try {
                answer(name, solver, line.trim().split("\\s+"), text);
            } catch (Exception | StackOverflowError | OutOfMemoryError why) {
                String said = why.getMessage() == null ? why.toString() : why.getMessage();
                text.setLength(0);
                text.append("error ").append(said.replaceAll("\\s+", " ")).append('\n');
            }
            out.print(text);
            out.flush();
        }
    }

    private static void answer(String name, Solver solver, String[] words, StringBuilder text) throws Exception {
        if (words[0].equals("hello")) {
            text.append("hello 1 ").append(name).append('\n');
            return;
        }
        List<double[]> rows = new ArrayList<>();
        Run run;
        if (words[0].equals("solve") || words[0].equals("driven-solve")) {
            run = new Run(words);
            // A run of no length is left to no library.
            double[][] states = run.grid.length > 1 ? solver.solve(run) : new double[0][];
            int at = 0;
            for (double t : run.asked) {
                if (t != run.grid[at]) at++;
                rows.add(at == 0 ? run.start : states[at - 1]);
            }
        } else if (words[0].equals("crossings")) {
            run = new Run(words);
            double[][] found = run.grid.length > 1 ? solver.crossings(run) : new double[0][];
            if (found == null) {
                text.append("unsupported\n");
                return;
            }
            rows = Arrays.asList(found);
        } else {
            text.append("unsupported\n");
            return;
        }
        for (double[] row : rows) {
            for (int i = 0; i < row.length; i++) text.append(i == 0 ? "" : " ").append(row[i]);
            text.append('\n');
        }
        text.append("done ").append(run.count).append('\n');
    }
}
