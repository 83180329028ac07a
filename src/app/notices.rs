//! The messages that are on show.

use super::model::Notice;

#[derive(Default)]
pub struct Notices {
    shown: Vec<Notice>,
    next_id: u64,
}

impl Notices {
    /// How long a message that is no error stays, s.
    const LIFETIME: f64 = 6.0;
    /// More than this many would cover the picture; the oldest go first.
    const MOST: usize = 4;

    /// Shows a message from `now` [s of egui's clock] for a while.
    pub fn tell(&mut self, now: f64, text: String) {
        self.add(text, false, Some(now + Self::LIFETIME));
    }

    /// Shows a message until it is dismissed.
    pub fn warn(&mut self, text: String) {
        if !self.shown.iter().any(|notice| notice.is_error && notice.text == text) {
            self.add(text, true, None);
        }
    }

    fn add(&mut self, text: String, is_error: bool, until: Option<f64>) {
        self.shown.push(Notice { id: self.next_id, text, is_error, until });
        self.next_id += 1;
        if self.shown.len() > Self::MOST {
            self.shown.remove(0);
        }
    }

    pub fn dismiss(&mut self, id: u64) {
        self.shown.retain(|notice| notice.id != id);
    }

    /// Takes away what has been up long enough; returns when the next one goes, in seconds from `now`.
    pub fn expire(&mut self, now: f64) -> Option<f64> {
        self.shown.retain(|notice| notice.until.is_none_or(|until| until > now));
        self.shown.iter().filter_map(|notice| notice.until).map(|until| until - now).reduce(f64::min)
    }

    pub fn shown(&self) -> &[Notice] {
        &self.shown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_go_by_themselves_and_errors_stay() {
        let mut notices = Notices::default();
        notices.tell(10.0, "saved".to_owned());
        notices.warn("failed".to_owned());
        assert_eq!(notices.expire(12.0), Some(Notices::LIFETIME - 2.0));
        assert_eq!(notices.shown().len(), 2);
        assert_eq!(notices.expire(10.0 + Notices::LIFETIME), None);
        assert_eq!(notices.shown().iter().map(|n| n.text.as_str()).collect::<Vec<_>>(), ["failed"]);
        notices.dismiss(notices.shown()[0].id);
        assert!(notices.shown().is_empty());
    }

    #[test]
    fn an_error_is_shown_once() {
        let mut notices = Notices::default();
        notices.warn("failed".to_owned());
        notices.warn("failed".to_owned());
        assert_eq!(notices.shown().len(), 1);
    }
}
