//! Results for people, scripts and spreadsheets: summaries, tables and JSON of what several commands find.

pub mod beyond;
pub mod doubts;
pub mod facts;
pub mod groups;
pub mod joined;
pub mod motion;
pub mod numbered;
pub mod places;
pub mod solutions;
