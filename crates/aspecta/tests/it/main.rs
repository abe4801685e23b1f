//! The library as its users meet it, one module a subject: against closed forms, the paper's numbers, other people's methods
//! and brute force.
//!
//! All are one binary, so that the library is linked once; `cargo test -p aspecta paper` runs one subject.

mod agile_eye;
mod aspects;
mod bodies;
mod catalogue;
mod characteristic;
mod check;
mod conformance;
mod counts;
mod cusps;
mod direct;
mod domains;
mod enclosures;
mod explore;
mod follow;
mod free_body;
mod joint_ranges;
mod many_limits;
mod maps;
mod measures;
mod motion;
mod no_c;
mod obstacles;
mod paper;
mod paving;
mod random;
mod robot_files;
mod rod_angles;
mod singularity;
mod slice_domains;
mod slices;
mod spatial;
mod special_hexapods;
mod sweep;
mod time;
mod twins;
