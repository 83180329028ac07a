//! A fixed number of choices, each with a name for command lines and files and a label for people.

/// One of a few ways to do something.
pub trait Choice: Copy + Eq + 'static {
    /// All of them, in the order in which people are shown them.
    const ALL: &'static [Self];
    /// What they are, as in "no solver is called …".
    const KIND: &'static str;

    /// For command lines and files.
    fn name(self) -> &'static str;

    /// For people.
    fn label(self) -> &'static str;

    /// For people who want to know more: one sentence.
    fn meaning(self) -> &'static str;
}

/// The choice of this name.
///
/// # Errors
/// A message that lists the names there are.
pub fn parse<C: Choice>(text: &str) -> Result<C, String> {
    let found = C::ALL.iter().copied().find(|choice| choice.name() == text);
    found.ok_or_else(|| {
        let names: Vec<_> = C::ALL.iter().map(|choice| choice.name()).collect();
        format!("no {} is called `{text}` (there are {})", C::KIND, names.join(", "))
    })
}
