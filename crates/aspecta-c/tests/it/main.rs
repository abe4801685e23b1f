//! The library as C meets it: its header, and a program.

mod c_program;
mod header;
mod joint_ranges;
