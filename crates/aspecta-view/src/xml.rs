//! Escaping and numbers for every file in XML: SVG, MJCF and VTK.

/// `text` with the characters that mean something in XML written out.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
