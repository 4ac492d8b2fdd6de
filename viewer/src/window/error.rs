//! Why a window cannot be opened, or had to close.

use lensbake_interactive::state::Refusal;
use lensbake_render::gpu::GpuError;
use lensbake_render::sky::SkyError;
use thiserror::Error;

/// A window that cannot be opened, or had to close.
#[derive(Debug, Error)]
pub enum WindowError {
    /// There is no screen.
    #[error("{0}")]
    NoScreen(String),
    /// The window system failed.
    #[error("the window failed: {0}")]
    WindowSystem(String),
    /// There is no GPU, or it failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The sky cannot be loaded.
    #[error(transparent)]
    Sky(#[from] SkyError),
    /// The view or the table cannot be drawn.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl WindowError {
    /// Whether this machine can open no window at all. A picture can still be drawn without one.
    pub fn is_no_window(&self) -> bool {
        matches!(
            self,
            WindowError::NoScreen(_)
                | WindowError::Gpu(
                    GpuError::NoAdapter | GpuError::NoDevice { .. } | GpuError::NoSurface(_)
                )
        )
    }

    /// [`WindowError::NoScreen`] with the reason that the window system gives.
    pub(super) fn no_screen(error: &impl ToString) -> Self {
        WindowError::NoScreen(plain(&error.to_string()))
    }
}

/// The reason in a message of winit, without the source location and the debug output of X11 errors.
fn plain(text: &str) -> String {
    let reason = match text.strip_prefix("os error at ") {
        Some(rest) => {
            let line = rest.split_once(".rs:").map_or(rest, |(_file, line)| line);
            line.split_once(": ")
                .map_or(line, |(_number, reason)| reason)
        }
        None => text,
    };
    let request = reason.split_once("request_name: Some(\"");
    if let Some((request, _)) = request.and_then(|(_, rest)| rest.split_once('"')) {
        return format!("the X server refuses {request}");
    }
    let reason = reason.split_once(" {").map_or(reason, |(reason, _)| reason);
    reason.trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_window_system_says_can_be_read() {
        let says = |text: &str| WindowError::no_screen(&text).to_string();
        let refused = "os error at /a/b: c/window.rs:312: X11 error: X11Error { error_kind: Value, \
            error_code: 2, sequence: 20, bad_value: 0, minor_opcode: 0, major_opcode: 1, \
            extension_name: None, request_name: Some(\"CreateWindow\") }";
        let refused = says(refused);
        assert_eq!(refused, "the X server refuses CreateWindow");
        let closed = says("os error at /a/mod.rs:7: Failed to open connection to X server.");
        assert_eq!(closed, "Failed to open connection to X server");
        let unknown = says(
            "os error at /a/mod.rs:7: X11 error: X11Error { error_kind: Unknown(7), request_name: None }",
        );
        assert_eq!(unknown, "X11 error: X11Error");
        let nested = says("os error at /a/mod.rs:7: Xlib error: XOpenDisplay failed: no such host");
        assert!(
            nested.contains("Xlib error: XOpenDisplay failed: no such host"),
            "{nested}"
        );
    }
}
