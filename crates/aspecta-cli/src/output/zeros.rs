//! JSON in which no zero has a sign.

use super::unsigned;
use serde_json::ser::Formatter;
use std::io::{self, Write};

/// The layout `F`, in which −0 is written as 0.
pub struct UnsignedZeros<F>(pub F);

/// Hands these methods of a layout on to the one inside.
macro_rules! as_inside {
    ($($method:ident ( $($flag:ident)? )),* $(,)?) => {
        $(fn $method<W: ?Sized + Write>(&mut self, out: &mut W $(, $flag: bool)?) -> io::Result<()> {
            self.0.$method(out $(, $flag)?)
        })*
    };
}

impl<F: Formatter> Formatter for UnsignedZeros<F> {
    fn write_f64<W: ?Sized + Write>(&mut self, out: &mut W, x: f64) -> io::Result<()> {
        self.0.write_f64(out, unsigned(x))
    }

    as_inside! {
        begin_array(), end_array(), begin_array_value(first), end_array_value(),
        begin_object(), end_object(), begin_object_key(first), end_object_key(), begin_object_value(), end_object_value(),
    }
}

#[cfg(test)]
mod tests {
    use crate::output::{json, json_line};
    use serde_json::json;

    #[test]
    fn only_the_sign_of_zeros_is_lost() {
        let value = json!({ "a": [-0.0, 0.0, -1.5e-300, { "b": [] }], "c": {}, "d": -0.0 });
        let mut pretty = Vec::new();
        json(&mut pretty, &value).unwrap();
        let usual = serde_json::to_string_pretty(&value).unwrap().replace("-0.0", "0.0");
        assert_eq!(String::from_utf8(pretty).unwrap(), usual + "\n");
        let mut line = Vec::new();
        json_line(&mut line, &value).unwrap();
        let usual = value.to_string().replace("-0.0", "0.0");
        assert_eq!(String::from_utf8(line).unwrap(), usual + "\n");
    }
}
