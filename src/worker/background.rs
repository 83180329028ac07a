//! Work on a thread of its own that tells how far it is.

use super::pool;
use crate::cancel::Cancel;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A handle on the work. Dropping it cancels what is left, without waiting.
pub struct Background<T> {
    cancel: Cancel,
    latest: Arc<Mutex<Arc<T>>>,
}

/// The work's own side of it.
pub struct Desk<T> {
    pub cancel: Cancel,
    latest: Arc<Mutex<Arc<T>>>,
    wake: Box<dyn Fn() + Send>,
}

impl<T: Send + Sync + 'static> Background<T> {
    /// Starts the work on a thread of this name; `first` is what there is to tell before it has done anything. `wake` is called
    /// from its thread after everything new.
    pub fn spawn(
        name: &str,
        first: T,
        wake: impl Fn() + Send + 'static,
        work: impl FnOnce(&Desk<T>) + Send + 'static,
    ) -> Self {
        let (cancel, latest) = (Cancel::default(), Arc::new(Mutex::new(Arc::new(first))));
        let desk = Desk { cancel: cancel.clone(), latest: latest.clone(), wake: Box::new(wake) };
        let thread = std::thread::Builder::new().name(name.to_owned());
        thread.spawn(|| pool::in_background(move || work(&desk))).expect("the system can start a thread");
        Self { cancel, latest }
    }

    /// What was told last. Never waits for the work.
    pub fn latest(&self) -> Arc<T> {
        lock(&self.latest).clone()
    }
}

impl<T> Desk<T> {
    /// Tells something new.
    pub fn publish(&self, news: T) {
        *lock(&self.latest) = Arc::new(news);
        (self.wake)();
    }
}

impl<T> Drop for Background<T> {
    fn drop(&mut self) {
        self.cancel.request();
    }
}

fn lock<T>(latest: &Mutex<Arc<T>>) -> MutexGuard<'_, Arc<T>> {
    latest.lock().unwrap_or_else(PoisonError::into_inner)
}
