% Solvers of GNU Octave 7.3.0 (Debian: octave 7.3.0-2), as strangers, protocol 1 of the judge:
%
%     octave-cli --no-gui octave/solver.m SOLVER
%
% ode23, ode45 and ode23s take the vector of times, and interpolate; a single time is the end of the
% last step. They have events.
1;

function dy = rate (t, y, run)
  global count
  count += 1;
  dy = [y(2); run.a * cos(run.w * t) - run.g * sin(y(1))];
endfunction

function [value, terminal, direction] = theta (t, y)
  value = y(1);
  terminal = 0;
  direction = 0;
endfunction

% One request: theta'' = -g sin theta + a cos(w t), from the first time of the grid on, or back.
function run = request (verb, x)
  if (! strcmp (verb, "driven-solve"))
    x = [x(1), 0, 0, x(2:end)];
  endif
  if (strcmp (verb, "crossings"))
    x([7, 8]) = x([8, 7]);  % The end stands before the tolerance.
  endif
  run = struct ("g", x(1), "a", x(2), "w", x(3), "start", x(4:5), "tol", x(7), "asked", x(8:end));
  % Where the run begins, and then each of the times once.
  grid = x([6, 8:end]);
  run.grid = grid([true, diff(grid) != 0]);
  % A library that hangs with these, or takes them for others, is not asked.
  if (! all (isfinite (run.grid)))
    error ("a time is not finite");
  elseif (numel (unique (sign (diff (run.grid)))) > 1)
    error ("the times turn round");
  endif
  run.each = run.tol * [1, sqrt(abs (run.g))];
endfunction

function states = solve (name, run)
  f = @(t, y) rate (t, y, run);
  options = odeset ("RelTol", run.tol, "AbsTol", run.each);
  [t, y] = feval (name, f, run.grid, run.start, options);
  if (numel (run.grid) == 2)
    y = y([1, end], :);
    t = t([1, end]);
  endif
  if (numel (t) != numel (run.grid) || max (abs (t(:) - run.grid(:))) > 1e-9 * max (abs (run.grid)))
    error ("it did not reach the end");
  endif
  states = y(2:end, :);
endfunction

function rows = crossings (name, run)
  options = odeset ("RelTol", run.tol, "AbsTol", run.each, "Events", @theta);
  [~, ~, t, y] = feval (name, @(t, y) rate (t, y, run), run.grid, run.start, options);
  rows = [t(:), y];
endfunction

name = argv (){end};
warning ("off", "all");
while (true)
  % fgetl waits for what comes behind the line.
  words = strsplit (strtrim (input ("", "s")));
  global count
  count = 0;
  try
    switch (words{1})
      case "bye"
        break
      case "hello"
        printf ("hello 1 %s\n", name);
      case {"solve", "driven-solve"}
        run = request (words{1}, str2double (words(2:end)));
        states = run.start;
        % A run of no length is left to no library.
        if (numel (run.grid) > 1)
          states = [states; solve(name, run)];
        endif
        at = cumsum ([run.asked(1) != run.grid(1), diff(run.asked) != 0]) + 1;
        printf ("%.17g %.17g\n", states(at, :)');
        printf ("done %d\n", count);
      case "crossings"
        run = request (words{1}, str2double (words(2:end)));
        rows = [];
        if (numel (run.grid) > 1)
          rows = crossings (name, run);
        endif
        if (! isempty (rows))
          printf ("%.17g %.17g %.17g\n", rows');
        endif
        printf ("done %d\n", count);
      otherwise
        printf ("unsupported\n");
    endswitch
  catch why
    printf ("error %s\n", regexprep (why.message, '\s+', " "));
  end_try_catch
  fflush (stdout);
endwhile
