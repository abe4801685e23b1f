//! The header in the repository is the one that cbindgen makes of the sources.

use cbindgen::{Builder, Config};
use std::fs;
use std::path::Path;

#[test]
fn the_header_is_that_of_the_sources() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = Config::from_file(here.join("cbindgen.toml")).unwrap();
    let bindings = Builder::new().with_config(config).with_src(here.join("src/lib.rs")).generate().unwrap();
    let mut made = Vec::new();
    bindings.write(&mut made);
    let made = String::from_utf8(made).unwrap();
    let path = here.join("include/aspecta.h");
    if std::env::var_os("ASPECTA_WRITE_HEADER").is_some() {
        fs::write(&path, &made).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap();
    let renew = "renew it: ASPECTA_WRITE_HEADER=1 cargo test -p aspecta-c header";
    assert!(kept == made, "include/aspecta.h is not what its sources say; {renew}");
}
