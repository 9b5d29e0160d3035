//! Exact coordinates as strings such as "1029/10" in serialised data.

/// For `#[serde(with)]` on an exact number.
pub mod number {
    use serde::{Deserialize, Deserializer, Serializer};

    use groebot_algebra::number::{BigRational, parse_rational};

    /// Writes a string.
    pub fn serialize<S: Serializer>(number: &BigRational, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(number)
    }

    /// Reads a string.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<BigRational, D::Error> {
        parse_rational(&String::deserialize(deserializer)?).map_err(serde::de::Error::custom)
    }
}

/// For `#[serde(with)]` on an exact vector.
pub mod vector {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::super::ExactVector;
    use groebot_algebra::number::parse_rational;

    /// Writes three strings.
    pub fn serialize<S: Serializer>(vector: &ExactVector, serializer: S) -> Result<S::Ok, S::Error> {
        vector.each_ref().map(|x| x.to_string()).serialize(serializer)
    }

    /// Reads three strings.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<ExactVector, D::Error> {
        let [x, y, z] = <[String; 3]>::deserialize(deserializer)?;
        let read = |text: &str| parse_rational(text).map_err(serde::de::Error::custom);
        Ok([read(&x)?, read(&y)?, read(&z)?])
    }
}

/// For `#[serde(with)]` on an exact matrix.
pub mod matrix {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::super::{ExactMatrix, ExactVector};
    use super::vector;

    #[derive(Serialize, Deserialize)]
    struct Row(#[serde(with = "vector")] ExactVector);

    /// Writes three rows.
    pub fn serialize<S: Serializer>(matrix: &ExactMatrix, serializer: S) -> Result<S::Ok, S::Error> {
        matrix.clone().map(Row).serialize(serializer)
    }

    /// Reads three rows.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<ExactMatrix, D::Error> {
        Ok(<[Row; 3]>::deserialize(deserializer)?.map(|row| row.0))
    }
}

/// For `#[serde(with)]` on an exact vector that may be absent.
pub mod optional_vector {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::super::ExactVector;
    use super::vector;

    #[derive(Serialize, Deserialize)]
    struct Vector(#[serde(with = "vector")] ExactVector);

    /// Writes three strings.
    pub fn serialize<S: Serializer>(vector: &Option<ExactVector>, serializer: S) -> Result<S::Ok, S::Error> {
        vector.clone().map(Vector).serialize(serializer)
    }

    /// Reads three strings.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<ExactVector>, D::Error> {
        Ok(Option::<Vector>::deserialize(deserializer)?.map(|vector| vector.0))
    }
}
