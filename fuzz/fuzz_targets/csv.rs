#![no_main]

libfuzzer_sys::fuzz_target!(|text: &[u8]| aspecta_fuzz::csv(text));
