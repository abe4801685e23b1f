use aspecta::certificate::Certificate;
use aspecta::verify::Checked;
use aspecta::{Control, catalogue, verify};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// The time that a certificate is checked for: what is longer is a matter of `verify --budget`.
const PATIENCE: Duration = Duration::from_millis(100);

/// Certificates: one that is read is written and read again as the same, and ends when it is cancelled; one
/// that is verified claims nothing wrong of a robot of which the truth is known.
pub fn certificate(text: &[u8]) {
    let Ok(certificate) = Certificate::from_json(text) else { return };
    let written = certificate.to_json().expect("a certificate is written");
    let again = Certificate::from_json(written.as_bytes()).expect("what is written is read");
    assert_eq!(again, certificate);
    let verdict = patiently(|control| verify(&certificate, control));
    assert!(!verdict.to_string().is_empty());
    if verdict.is_verified() && is_five_bar(&certificate) {
        for Checked { mode, det_a, claimed, .. } in &verdict.classes {
            let truth = aspects_of_the_five_bar(&mode.to_string(), *det_a);
            assert!(claimed.low <= truth && claimed.high.is_none_or(|high| truth <= high), "{mode} {det_a}");
        }
    }
}

fn is_five_bar(certificate: &Certificate) -> bool {
    let robot = catalogue::find("five-bar").expect("a robot of the catalogue");
    certificate.robot == robot && robot.slice(&[]).is_ok_and(|window| window == certificate.window)
}

/// Table 2 of the paper.
fn aspects_of_the_five_bar(mode: &str, det_a: i8) -> usize {
    if matches!((mode, det_a), ("+-", -1) | ("-+", 1)) { 2 } else { 1 }
}

/// Does work that is cancelled when it takes too long.
fn patiently<T>(work: impl FnOnce(&Control<'_>) -> T) -> T {
    let cancelled = AtomicBool::new(false);
    thread::scope(|scope| {
        let (done, is_done) = mpsc::channel::<()>();
        let cancelled = &cancelled;
        scope.spawn(move || {
            // Nothing is sent: it is done when the sender is gone.
            let _ = is_done.recv_timeout(PATIENCE);
            cancelled.store(true, Ordering::Relaxed);
        });
        let result = work(&Control { cancelled, progress: &|_| {} });
        drop(done);
        result
    })
}
