/// What can go wrong in training or with a model file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SurrogateError {
    /// A training row or the set of rows is unusable.
    #[error("training data: {0}")]
    Data(String),
    /// A training option is out of range.
    #[error("training option {key} = {value}, allowed: {allowed}")]
    Option { key: &'static str, value: String, allowed: &'static str },
    /// The text is no model: not JSON, cut short, or with missing or unknown keys.
    #[error("model file is damaged: {0}")]
    Damaged(String),
    /// A model of another schema.
    #[error("model file has schema \"{found}\", this library reads \"{expected}\"")]
    Schema { found: String, expected: &'static str },
    /// A value that no trained model has.
    #[error("model file: {key} = {value}, allowed: {allowed}")]
    Field { key: String, value: String, allowed: &'static str },
}
