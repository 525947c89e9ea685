# deSolve 1.34 (Debian: r-cran-desolve 1.34-1), as strangers, protocol 1 of `pendula verify`:
#
#     Rscript r/solver.R METHOD
#
# `ode` with the vector of times that is asked for; how they are met is the method's own affair. lsoda,
# lsode and radau look for roots (`rootfunc`, with an event that changes nothing, so that it goes on).
suppressMessages(library(deSolve))

name <- commandArgs(trailingOnly = TRUE)[1]
method <- if (grepl("^rk", name)) rkMethod(name) else name
rooted <- name %in% c("lsoda", "lsode", "radau")

# One request: theta'' = -g sin theta + a cos(w t), from the first time of the grid on, or back.
request <- function(verb, x) {
  if (verb != "driven-solve") x <- append(x, c(0, 0), after = 1)
  if (verb == "crossings") x[7:8] <- x[8:7]  # The end stands before the tolerance.
  if (length(x) < 8 || anyNA(x[-7])) stop("numbers are missing")
  asked <- x[8:length(x)]
  grid <- c(x[6], asked)
  # Where the run begins, and then each of the times once.
  grid <- grid[c(TRUE, diff(grid) != 0)]
  # A library that hangs with these, or takes them for others, is not asked.
  if (!all(is.finite(grid))) stop("a time is not finite")
  if (length(unique(sign(diff(grid)))) > 1) stop("the times turn round")
  list(g = x[1], a = x[2], w = x[3], start = x[4:5], tol = x[7], asked = asked, grid = grid)
}

# The derivatives of angle and velocity, counted.
count <- 0
rate <- function(t, y, run) {
  count <<- count + 1
  list(c(y[2], run$a * cos(run$w * t) - run$g * sin(y[1])))
}

# Its solution, whole: a run that ends early is told by a warning alone.
solution <- function(run, ...) {
  sink(stderr())  # What the library prints is no answer.
  on.exit(sink())
  each <- run$tol * c(1, sqrt(abs(run$g)))
  found <- withCallingHandlers(
    ode(run$start, run$grid, rate, run, method = method, rtol = run$tol, atol = each,
        maxsteps = 1e6, ...),
    warning = function(why) stop(conditionMessage(why)))
  # Of a run that ends early the last row has its own time.
  if (nrow(found) != length(run$grid)) stop("it did not reach the end")
  if (any(abs(found[, 1] - run$grid) > 1e-9 * max(abs(run$grid)))) stop("it ended elsewhere")
  found
}

answer <- function(verb, x) {
  run <- request(verb, x)
  count <<- 0
  rows <- matrix(0, 3, 0)
  if (length(run$grid) == 1) {
    states <- matrix(run$start, 1)
  } else if (verb == "crossings") {
    found <- solution(run, rootfunc = function(t, y, run) y[1],
                      events = list(func = function(t, y, run) y, root = TRUE))
    times <- attr(found, "troot")
    if (!is.null(times)) rows <- rbind(times, attr(found, "valroot"))
  } else {
    states <- solution(run)[, 2:3, drop = FALSE]
  }
  if (verb != "crossings") {
    at <- cumsum(c(run$asked[1] != run$grid[1], diff(run$asked) != 0)) + 1
    rows <- t(states[at, , drop = FALSE])
  }
  text <- apply(rows, 2, function(row) paste(sprintf("%.17g", row), collapse = " "))
  c(text, paste("done", count))
}

input <- file("stdin", "r")
while (length(said <- readLines(input, n = 1)) > 0) {
  words <- strsplit(trimws(said), "\\s+")[[1]]
  if (words[1] == "bye") break
  if (words[1] == "hello") {
    told <- paste("hello 1", name)
  } else if (words[1] %in% c("solve", "driven-solve", if (rooted) "crossings")) {
    numbers <- suppressWarnings(as.numeric(words[-1]))
    refused <- function(why) paste("error", gsub("\\s+", " ", conditionMessage(why)))
    told <- tryCatch(answer(words[1], numbers), error = refused)
  } else {
    told <- "unsupported"
  }
  writeLines(told)
  flush(stdout())
}
