//! Writes the JavaScript through which a page calls the WebAssembly of `lensbake-web`: what the program of
//! `wasm-bindgen-cli` does, with the version of the lock file.

use std::process::ExitCode;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, folder] = &arguments[..] else {
        return fail("usage: lensbake-bindgen FILE.wasm FOLDER");
    };
    let mut bindgen = Bindgen::new();
    let made = bindgen.web(true).and_then(|bindgen| {
        bindgen
            .input_path(input)
            .typescript(false)
            .remove_name_section(true)
            .remove_producers_section(true)
            .generate(folder)
    });
    match made {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => fail(&format!("{input}: {error:#}")),
    }
}

#[expect(clippy::print_stderr, reason = "a program for the build alone")]
fn fail(why: &str) -> ExitCode {
    eprintln!("lensbake-bindgen: {why}");
    ExitCode::from(2)
}
