//! What a refusal must say.

use striae::Result;

/// The message names `argument`, gives `value` and says what is accepted.
pub(crate) fn assert_named<T>(result: Result<T>, argument: &str, value: f64) {
    let Err(error) = result else {
        panic!("{argument} = {value} is accepted");
    };
    let message = error.to_string();
    assert!(
        message.contains(argument) && message.contains(&format!(" is {value}")),
        "{argument} = {value} is answered with \"{message}\""
    );
    assert!(
        message.contains("; accepted: ") && !message.ends_with(": "),
        "what is accepted for {argument}? \"{message}\""
    );
    assert!(
        !error.argument().is_empty() || message.contains('['),
        "{message}: no argument"
    );
}

/// Each of `values` for `argument` is refused, by name.
pub(crate) fn assert_refused<T>(argument: &str, values: &[f64], call: impl Fn(f64) -> Result<T>) {
    for &value in values {
        assert_named(call(value), argument, value);
    }
}
