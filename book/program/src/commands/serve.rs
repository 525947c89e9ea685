//! `pendula serve`: a method of the library as a program that answers on standard input and output.

use std::io::{self, Write};

use clap::Args;
use pendula::method_named;

use super::arguments::system::methods;
use crate::verify::serve::serve;
use pendula_output::failure::Failure;

/// Arguments of `pendula serve`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(value_name = "METHOD", value_parser = methods())]
    method: String,
}

/// Answers the requests on standard input until `bye`, or until they end.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let method = method_named(&arguments.method)
        .ok_or_else(|| Failure::refused(format!("{}: no such method", arguments.method)))?;
    Ok(serve(method, io::stdin().lock(), out)?)
}
