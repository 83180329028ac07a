//! The pictures from one camera, one for each view that was looked at from there, and what each of them needs next.

use crate::cancel::Cancel;
use crate::clock::Stopwatch;
use crate::methods::Step;
use crate::solution::{CameraImage, CameraView};
use crate::worker::workshop::{CameraShot, ImageMethod};

/// All pictures are from the same camera, of the same size, by the same settings.
pub struct Easel<I> {
    pictures: Vec<Picture<I>>,
    /// Those from where the camera was before, one for each view: they lend what was prepared of their light.
    former: Vec<Picture<I>>,
    pub has_crashed: bool,
}

impl<I> Default for Easel<I> {
    fn default() -> Self {
        Self { pictures: Vec::new(), former: Vec::new(), has_crashed: false }
    }
}

/// How much light there is for a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Amount {
    /// Which start from the emitters it belongs to.
    pub start: u64,
    /// Which pass of photons, from 0.
    pub pass: u64,
    /// Steps, or batches of the pass.
    pub count: u64,
    /// Whether the pass is whole: one of many, each of which gives the picture a sample of every pixel.
    pub is_whole_pass: bool,
}

/// The light that a picture is read off, at this moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Source {
    pub amount: Amount,
    /// Whether more is on its way.
    pub is_growing: bool,
    /// Whether all passes are done.
    pub is_done: bool,
}

/// What a picture needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    Nothing,
    /// To be begun anew from the light that there is now.
    Begin,
    /// To go on with the light of another pass.
    GoOn,
    Expose,
}

/// A picture with a clock.
pub struct Picture<I> {
    shot: CameraShot,
    image: I,
    made_of: Amount,
    watch: Stopwatch,
    shown: Option<Published>,
}

/// What was shown last of a view.
#[derive(Clone, Copy, Debug)]
struct Published {
    made_of: Amount,
    fineness: u32,
}

impl<I: ImageMethod> Easel<I> {
    /// Makes room for pictures of this shot's camera and size.
    pub fn look(&mut self, shot: &CameraShot) {
        let is_same = |old: &CameraShot| old.camera == shot.camera && old.size == shot.size;
        if !self.pictures.iter().all(|picture| is_same(&picture.shot)) {
            let pictures = std::mem::take(&mut self.pictures);
            let is_seen = |view| pictures.iter().any(|picture| picture.shot.view == view);
            self.former.retain(|picture| !is_seen(picture.shot.view));
            self.former.extend(pictures);
        }
    }

    /// Forgets all pictures.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Forgets the pictures of some views.
    pub fn forget(&mut self, is_forgotten: impl Fn(CameraView) -> bool) {
        self.pictures.retain(|picture| !is_forgotten(picture.shot.view));
        self.former.retain(|picture| !is_forgotten(picture.shot.view));
    }

    /// A picture before its first step, by what one from elsewhere knows of the same light, if there is one.
    pub fn moved_to(&self, shot: &CameraShot, made_of: Amount) -> Option<I> {
        let has_same_light = |old: &&Picture<I>| old.shot.view == shot.view && old.made_of == made_of;
        self.former.iter().find(has_same_light).map(|old| old.image.moved_to(shot))
    }

    pub fn picture(&self, view: CameraView) -> Option<&Picture<I>> {
        self.pictures.iter().find(|picture| picture.shot.view == view)
    }

    pub fn picture_mut(&mut self, view: CameraView) -> Option<&mut Picture<I>> {
        self.pictures.iter_mut().find(|picture| picture.shot.view == view)
    }

    /// Puts up a picture in place of an older one of the same view, which stays on show until this one is as good. Its steps
    /// are timed by `watch`.
    pub fn begin(&mut self, shot: CameraShot, image: I, made_of: Amount, watch: Stopwatch) {
        let old = self.picture(shot.view).and_then(|old| old.shown);
        let shown = old.filter(|old| old.made_of.start == made_of.start);
        self.forget(|view| view == shot.view);
        self.pictures.push(Picture { shot, image, made_of, watch, shown });
    }
}

impl<I: ImageMethod> Picture<I> {
    /// Whether nothing of it has been shown.
    pub fn is_first(&self) -> bool {
        self.shown.is_none()
    }

    /// What it needs, given the light that there is, until every pixel has `samples`.
    pub fn next(&self, now: &Source, samples: u32) -> Next {
        next(
            self.made_of,
            now,
            Film { samples: self.image.samples(), is_between: self.image.is_between_passes() },
            samples,
        )
    }

    /// The image and the note of what it is made of, to go on with other light.
    pub fn go_on(&mut self, made_of: Amount) -> &mut I {
        self.made_of = made_of;
        &mut self.image
    }

    /// One step on the clock.
    pub fn step(&mut self, cancel: &Cancel) -> Step {
        self.watch.time(|| self.image.step(cancel))
    }

    /// The picture, once it should take the place of what is shown of its view.
    pub fn publish(&mut self) -> Option<CameraImage> {
        let image = self.image.image()?;
        let fineness = if image.samples > 0 { u32::MAX } else { image.resolution[0] };
        let is_better = self.shown.is_none_or(|old| fineness >= old.fineness || self.made_of.outgrows(&old.made_of));
        if !is_better {
            return None;
        }
        self.shown = Some(Published { made_of: self.made_of, fineness });
        Some(CameraImage { elapsed: self.watch.elapsed(), ..image })
    }
}

/// How far the film of a picture is exposed.
#[derive(Clone, Copy, Debug)]
struct Film {
    samples: u32,
    is_between: bool,
}

/// See [`Picture::next`].
fn next(made_of: Amount, now: &Source, film: Film, samples: u32) -> Next {
    let has_sampled = film.samples > 0 && film.is_between;
    if made_of.start != now.amount.start {
        return Next::Begin;
    }
    if made_of.is_whole_pass && made_of.pass != now.amount.pass {
        // What comes of the next pass is of no use before it is whole.
        return match (has_sampled, now.amount.is_whole_pass) {
            (false, _) => Next::Expose,
            (true, true) => Next::GoOn,
            (true, false) => Next::Nothing,
        };
    }
    let is_shown = film.samples > 0;
    if made_of.is_stale(now) && (is_shown || now.amount.outgrows(&made_of)) {
        return Next::Begin;
    }
    // A sample more would give this pass more weight than the others.
    if made_of.is_whole_pass && !now.is_done {
        return if has_sampled { Next::Nothing } else { Next::Expose };
    }
    if film.samples >= samples { Next::Nothing } else { Next::Expose }
}

impl Amount {
    /// Whether a picture made of this should be made anew: while light comes in, not for less than a quarter more of it.
    fn is_stale(&self, now: &Source) -> bool {
        let Source { amount, is_growing, .. } = *now;
        let is_more = amount.pass != self.pass || 4 * amount.count >= 5 * self.count;
        *self != amount && (is_more || !is_growing || amount.is_whole_pass)
    }

    /// Whether a picture made of this, coarse as it may be, says more than one made of the other.
    fn outgrows(&self, other: &Self) -> bool {
        self.pass != other.pass || self.count >= 2 * other.count && self.count != other.count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(count: u64) -> Amount {
        Amount { start: 1, count, ..Amount::default() }
    }

    fn growing(amount: Amount) -> Source {
        Source { amount, is_growing: true, is_done: false }
    }

    /// What a picture made of `made_of` needs that has so many samples, up to eight, and none of the next one.
    fn after(made_of: Amount, samples: u32, now: &Source) -> Next {
        next(made_of, now, Film { samples, is_between: true }, 8)
    }

    #[test]
    fn a_picture_is_exposed_until_it_has_its_samples() {
        let now = Source { amount: steps(10), ..Source::default() };
        assert_eq!(
            [0, 7, 8].map(|samples| after(steps(10), samples, &now)),
            [Next::Expose, Next::Expose, Next::Nothing]
        );
        let other_start = Source { amount: Amount { start: 2, ..steps(10) }, ..now };
        assert_eq!(after(steps(10), 0, &other_start), Next::Begin);
    }

    #[test]
    fn a_picture_is_made_anew_when_its_light_has_grown_and_something_of_it_was_seen() {
        assert_eq!([124, 125].map(|now| after(steps(100), 1, &growing(steps(now)))), [Next::Expose, Next::Begin]);
        // A coarse one is finished first, unless it says next to nothing.
        assert_eq!([125, 200].map(|now| after(steps(100), 0, &growing(steps(now)))), [Next::Expose, Next::Begin]);
        assert_eq!(after(steps(0), 0, &growing(steps(1))), Next::Begin);
        // All that there is counts once the light rests.
        let resting = Source { amount: steps(101), ..Source::default() };
        assert_eq!(after(steps(100), 8, &resting), Next::Begin);
    }

    #[test]
    fn every_pass_of_photons_gives_one_sample() {
        let pass = |pass, is_whole_pass| Amount { start: 1, pass, count: 5, is_whole_pass };
        let whole = pass(3, true);
        assert_eq!([0, 1].map(|samples| after(whole, samples, &growing(whole))), [Next::Expose, Next::Nothing]);
        assert_eq!(after(whole, 1, &growing(pass(4, false))), Next::Nothing);
        assert_eq!(after(whole, 1, &growing(pass(4, true))), Next::GoOn);
        let exposing = Film { samples: 1, is_between: false };
        assert_eq!(next(whole, &growing(pass(4, true)), exposing, 8), Next::Expose);
        // What was made of a part of a pass has no place in the mean.
        assert_eq!(after(pass(3, false), 1, &growing(whole)), Next::Begin);
        // The last pass gives the samples that are still missing.
        let done = Source { amount: whole, is_growing: false, is_done: true };
        assert_eq!([1, 8].map(|samples| after(whole, samples, &done)), [Next::Expose, Next::Nothing]);
    }
}
