//! What is refused, and in which words.

use crate::call::{pendula, refused, words};

/// A command line each: of the command line itself, then command by command.
const LINES: &str = "\
bock
book --opne
preprocess supports
paper
sweep
verify
verify --
verify python3
serve
simulate --method rk4 --theta0 --dt 1
simulate --method rk4 --theta0 1 --dt 1
simulate --method rk4 --theta0 1 --duration 1
simulate --theta0 1 --dt 1 --steps 1
simulate --method rk4 --dt 1 --steps 1
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --duration 1
simulate --method rk4 --theta0 1 --dt 0.01 --steps -1
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --every 0
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --length 1m
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --mass nan
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --gravity -9.81
simulate --method rk4 --theta0 1 --dt 0.01 --steps 1 --omega0 inf
simulate --method rk4 --theta0 1 --dt 0.01 --duration 0.015
simulate --method rk4 --theta0 1 --dt 0.01 --steps 9007199254740993
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --max-steps 2
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --plot /no/such/folder/x.svg
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --output /no/such/folder/x.csv
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --state /no/such/folder/x.state
simulate --resume a.state --plot -
simulate --method dop853 --theta0 1 --duration 10 --tolerance 0
simulate --method dop853 --theta0 1 --duration 10 --tolerance 1e-16
simulate --method dop853 --theta0 1 --duration inf --tolerance 1e-6
simulate --method dop853 --theta0 nan --duration 10 --tolerance 1e-6
simulate --method dop853 --theta0 1 --duration 10 --tolerance 1e-6 --every 2
simulate --method rk4 --theta0 1 --duration 1 --tolerance 1e-6
simulate --method rk4 --theta0 1 --duration 1 --tolerance 1e-6 --dt 1
simulate --method dop853 --theta0 1 --duration 1 --tolerance 1e-6 --system damped --damping 1
simulate --method taylor-series --theta0 1 --dt 1 --steps 1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --damping 1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --theta1 1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system dampened
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system damped
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system damped --damping -1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system driven --drive-frequency 1
simulate --method rk4 --theta0 1 --dt 1 --steps 1 --system shaken --pivot-amplitude 1 --damping 1
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --duration 0.015
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 1 --mass2 0
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 1 --omega1 nan
simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 1 --mass 1
sweep --method rk4 --theta0 1 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:5 --dt 0.1:0.01:5 --duration 10
sweep --method rk4 --theta0 0:1:1 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:-3 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:2.5 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:5:5 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:nan:5 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1e16:5 --dt 0.01 --duration 10
sweep --method rk4 --theta0 0:1:5 --dt 0.015 --duration 0.1
sweep --method rk4 --theta0 1 --dt inf --duration 10
sweep --method rk4 --theta0 1 --dt -0.1:0.1:5 --duration 10
sweep --method rk4 --theta0 1 --dt 0.1:20:5 --duration 10
sweep --method rk4 --theta0 1 --dt 0.1:1e-300:5 --duration 10
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 4/3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 0/3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 1/0
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part -1/3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 1/3/3
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 1/18446744073709551616
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part --summary
sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1 --part 2/3 --format json
sweep --method rk4 --theta0 1 --dt 0.1:1:3 --duration 1 --device p
sweep flips --size 0
sweep flips --size 3
sweep flips --size 100000
sweep flips --dt 0.3 --duration 1
sweep flips --length1 0
sweep flips --size 2 --picture no/folder/a.png
exact --theta0 nan
exact --theta0 2/3pi
exact --theta0 1 --format json
exact --theta0 1 --t 1,two
exact --theta0 3 --t 1e300
exact --theta0 3 --t -inf
exact --theta0 3 --t nan
paper tables --table 3
paper tables --format xml
paper claims --verdict right
bench --seconds -1
verify --claims order=two -- true
verify --claims sympletic -- true
verify --patience 0 -- true
verify --patience -1 -- true
verify --patience nan -- true
verify --format xml -- true
verify --report /no/such/folder/x.html -- true
verify --example perl
verify --example c -- true
completions csh";

/// Where the program to be judged is named, it is not started: `true` would be at fault.
///
/// Catches: bad input that is accepted; a panic, a message of several lines, another exit status; a
/// message that does not say what is allowed, or whose option it is.
#[test]
fn bad_input_is_refused_in_one_line() {
    let of = |line| format!("$ pendula {line}\n{}", refused(&pendula(words(line))));
    let told: Vec<String> = LINES.lines().map(of).collect();
    insta::assert_snapshot!(told.concat());
}
