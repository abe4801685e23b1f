//! One standalone `report.html` and each of its figures as a file.
