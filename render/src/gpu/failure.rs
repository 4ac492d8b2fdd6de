//! The first error of a device, and who waits for it.

use futures_channel::oneshot;
use std::sync::{Arc, Mutex};

/// The first error of a device; a clone refers to the same device.
#[derive(Debug, Clone, Default)]
pub(super) struct Failure(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    first: Option<String>,
    waiting: Vec<oneshot::Sender<()>>,
}

impl Failure {
    /// Notes an error; only the first is kept.
    pub(super) fn note(&self, text: &str) {
        if let Ok(mut state) = self.0.lock() {
            state
                .first
                .get_or_insert_with(|| super::device::one_line(text));
            for waiting in state.waiting.drain(..) {
                // The receiver may have been dropped.
                let _ = waiting.send(());
            }
        }
    }

    /// The first error, if there was one.
    pub(super) fn first(&self) -> Option<String> {
        self.0.lock().ok()?.first.clone()
    }

    /// Waits for the first error. If all clones are dropped before, waits for ever.
    pub(super) fn wait(&self) -> impl Future<Output = String> + use<> {
        let (noted, waiting) = oneshot::channel();
        if let Ok(mut state) = self.0.lock() {
            match state.first {
                Some(_) => drop(noted.send(())),
                None => state.waiting.push(noted),
            }
        }
        let state = Arc::downgrade(&self.0);
        async move {
            let noted = waiting.await.is_ok();
            let state = state.upgrade().filter(|_| noted);
            match state.and_then(|state| Failure(state).first()) {
                Some(reason) => reason,
                None => std::future::pending().await,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pollster::block_on;

    #[test]
    fn who_waits_before_and_after_gets_the_first_error() {
        let failure = Failure::default();
        let before = failure.wait();
        assert_eq!(failure.first(), None);
        failure.note("lost:\n  reset");
        failure.note("another");
        assert_eq!(failure.first().as_deref(), Some("lost: reset"));
        assert_eq!(block_on(before), "lost: reset");
        assert_eq!(block_on(failure.wait()), "lost: reset");
    }
}
