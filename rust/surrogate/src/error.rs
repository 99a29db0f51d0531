use std::borrow::Cow;

/// Errors of training and of model files.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SurrogateError {
    /// A training row or the set of rows is unusable.
    #[error("training data: {0}")]
    Data(String),
    /// A training option is out of range.
    #[error("training option {key} = {value}, allowed: {allowed}", value = short(value))]
    Option { key: &'static str, value: String, allowed: Cow<'static, str> },
    /// The text is not a model file: not JSON, cut short, or with missing or unknown keys.
    #[error("model file is damaged: {0}")]
    Damaged(String),
    /// A model of another schema.
    #[error("model file has schema \"{found}\", this library reads \"{expected}\"")]
    Schema { found: String, expected: &'static str },
    /// A value that no trained model can have.
    #[error("model file: {key} = {value}, allowed: {allowed}", value = short(value))]
    Field { key: String, value: String, allowed: Cow<'static, str> },
}

/// A value for a message: a number of three hundred digits as 1e300, a long text without its middle.
fn short(value: &str) -> String {
    let count = value.chars().count();
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() && count > 20 => format!("{number:e}"),
        _ if count > 300 => {
            let start: String = value.chars().take(200).collect();
            format!("{start} … ({} characters left out)", count - 200)
        }
        _ => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_short() {
        let field = |value: String| {
            SurrogateError::Field { key: "k".to_string(), value, allowed: "0".into() }.to_string()
        };
        assert_eq!(field(1e300.to_string()), "model file: k = 1e300, allowed: 0");
        assert!(field("x".repeat(1_000_000)).len() < 300);
    }
}
