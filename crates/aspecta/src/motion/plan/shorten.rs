//! From a way over boxes to a path that is worth driving: waypoints are left out and moved, each time the
//! segments that change are proved anew.

use super::Proof;
use super::cost::Cost;

/// Waypoints further apart than this share of the window get one between them before they are moved.
const APART: f64 = 0.2;
/// The first step by which waypoints are moved, as a share of the window; halved each round.
const STEP: f64 = 0.04;
/// Rounds of moves.
const ROUNDS: usize = 5;
/// The share by which a path may cost more if that leaves out waypoints.
const THINNING: f64 = 0.01;

/// A path of proved segments, made cheaper; its ends stay.
pub(in crate::motion) fn improve<const K: usize>(
    proof: &Proof<'_>,
    cost: &Cost<'_, K>,
    path: Vec<[f64; K]>,
) -> Vec<[f64; K]> {
    let mut path = shortcut(proof, cost, path);
    for _ in 0..2 {
        if !cost.is_length() {
            path = subdivide(cost, &path);
        }
        let moved = relax(proof, cost, &mut path);
        path = shortcut(proof, cost, path);
        if !moved {
            break;
        }
    }
    thin(proof, cost, path)
}

/// Leaves out waypoints that hardly pay: a path with few corners is worth a little more length.
fn thin<const K: usize>(proof: &Proof<'_>, cost: &Cost<'_, K>, mut path: Vec<[f64; K]>) -> Vec<[f64; K]> {
    let mut allowance = THINNING * cost.of_all(&path);
    let mut k = 1;
    while k + 1 < path.len() {
        let (before, here, after) = (&path[k - 1], &path[k], &path[k + 1]);
        let extra = cost.of(before, after) - cost.of(before, here) - cost.of(here, after);
        if extra <= allowance && proof.holds(before, after) {
            allowance -= extra.max(0.0);
            path.remove(k);
        } else {
            k += 1;
        }
    }
    path
}

/// Goes from each waypoint straight to the furthest later one, doubling the number of waypoints that are left
/// out as long as that is proved and no dearer.
fn shortcut<const K: usize>(proof: &Proof<'_>, cost: &Cost<'_, K>, path: Vec<[f64; K]>) -> Vec<[f64; K]> {
    let mut dear = vec![0.0];
    for ends in path.windows(2) {
        dear.push(dear[dear.len() - 1] + cost.of(&ends[0], &ends[1]));
    }
    let good = |i: usize, j: usize| {
        let straight = cost.of(&path[i], &path[j]);
        straight <= (dear[j] - dear[i]) * (1.0 + 1e-9) && proof.holds(&path[i], &path[j])
    };
    let (mut at, last) = (0, path.len() - 1);
    let mut short = vec![path[0]];
    while at < last {
        let (mut step, mut next) = (2, at + 1);
        while next < last {
            let further = (at + step).min(last);
            if further > next && good(at, further) {
                next = further;
                step *= 2;
            } else if step > next - at + 1 {
                // Something between what was proved and what was not.
                step = (next - at) + (step - (next - at)) / 2;
            } else {
                break;
            }
        }
        short.push(path[next]);
        at = next;
    }
    short
}

/// Returns the path with more waypoints.
fn subdivide<const K: usize>(cost: &Cost<'_, K>, path: &[[f64; K]]) -> Vec<[f64; K]> {
    let mut fine = vec![path[0]];
    for ends in path.windows(2) {
        let parts = (cost.distance(&ends[0], &ends[1]) / (APART * cost.size)).ceil().max(1.0);
        for i in 1..parts as usize {
            let t = i as f64 / parts;
            fine.push(std::array::from_fn(|k| ends[0][k] + t * (ends[1][k] - ends[0][k])));
        }
        fine.push(ends[1]);
    }
    fine
}

/// Moves inner waypoints along the coordinates while that makes the path cheaper. Whether any was.
fn relax<const K: usize>(proof: &Proof<'_>, cost: &Cost<'_, K>, path: &mut [[f64; K]]) -> bool {
    let mut any = false;
    let mut length = STEP * cost.size;
    for _ in 0..ROUNDS {
        for i in 1..path.len().saturating_sub(1) {
            let (before, after) = (path[i - 1], path[i + 1]);
            let mut now = cost.of(&before, &path[i]) + cost.of(&path[i], &after);
            for (k, way) in (0..proof.axes()).flat_map(|k| [(k, 1.0), (k, -1.0)]) {
                let mut moved = path[i];
                moved[k] += way * cost.step(length, k);
                let then = cost.of(&before, &moved) + cost.of(&moved, &after);
                if then < now && proof.holds(&before, &moved) && proof.holds(&moved, &after) {
                    (path[i], now, any) = (moved, then, true);
                }
            }
        }
        length *= 0.5;
    }
    any
}
