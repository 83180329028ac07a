//! The threads of the solver: as many as there are cores, and all of them give way to the window.

use thread_priority::{ThreadPriority, ThreadPriorityValue, set_current_thread_priority};

/// On a scale from 0 to 100 on which other threads have about 50; on Linux this is a niceness of 10.
const PRIORITY: u8 = 23;

/// Runs `work`, and everything that it does in parallel, on threads of low priority. A machine with few cores then draws
/// a picture as soon as there is one, and the solver takes all that is left.
pub fn in_background(work: impl FnOnce() + Send) {
    match rayon::ThreadPoolBuilder::new().start_handler(|_| give_way()).build() {
        Ok(pool) => pool.install(work),
        Err(error) => {
            log::warn!("the solver shares the threads of the window: {error}");
            work();
        }
    }
}

/// Where the system does not allow it, the solver works as fast and the window draws more slowly: no reason to stop.
fn give_way() {
    let priority = ThreadPriorityValue::try_from(PRIORITY).expect("it is on the scale");
    if let Err(error) = set_current_thread_priority(ThreadPriority::Crossplatform(priority)) {
        log::warn!("the solver keeps its priority: {error:?}");
    }
}
