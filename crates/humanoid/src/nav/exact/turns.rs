//! Turns of a path: at the ends of windows, and along lattice lines.

use super::search::{Search, Turn};
use super::windows::{View, Window};

impl Search<'_> {
    /// Finds corners at the ends of a window.
    pub fn corners(&mut self, window: &Window) {
        let root = self.roots[window.view.root as usize].spot;
        let line = window.view.line();
        for (ray, x, is_right) in [(window.rays[0], window.opening.0, false), (window.rays[1], window.opening.1, true)]
        {
            // The window may end before its opening does.
            if ray.cross(self.plane.lattice(x as usize, line).from(root)) == 0 {
                self.corner(window, x as usize, is_right, if is_right { -ray.x } else { ray.x });
            }
        }
    }

    /// Turns at the left or right end of an opening, where a ray arrives with this inward slope.
    fn corner(&mut self, window: &Window, x: usize, is_right: bool, leans: i64) {
        let view = window.view;
        let row = view.row as usize;
        let from = if view.is_up { row - 1 } else { row + 1 };
        let (outside, inside) = if is_right { (x, x - 1) } else { (x - 1, x) };
        let is_open = [self.rows.has(outside, from), self.rows.has(outside, row)];
        // Over the end of the obstacle that bounds the row left, or around that of the row entered.
        let follows = match is_open {
            [false, true] => Some(is_right),
            [true, false] if leans > 0 => None,
            _ => return,
        };
        let ray = Some(window.rays[usize::from(is_right)]);
        let rays = if is_right { [ray, None] } else { [None, ray] };
        let turn = Turn { view, rays, cell: inside as u32, follows };
        self.turn_at(view.root, (x, view.line()), view.is_up != is_right, turn);
    }

    /// Follows a lattice line from one of its points to the first corner where a path may turn, or to the goal.
    /// `reaches` is whether the cells above the line and below it, before the point, can be reached.
    pub fn walk(&mut self, root: u32, (mut x, y): (usize, usize), is_right: bool, mut reaches: [bool; 2]) {
        let sides = [y, y - 1];
        loop {
            let cell = if is_right { x } else { x - 1 };
            let free = sides.map(|row| self.rows.has(cell, row));
            let straight = [0, 1].map(|side| free[side] && reaches[side]);
            reaches = [0, 1].map(|side| straight[side] || (free[side] && straight[1 - side]));
            if reaches == [false; 2] {
                return;
            }
            let ends = sides.map(|row| self.rows.alike(cell, row, is_right));
            let end = if is_right { ends[0].min(ends[1]) } else { ends[0].max(ends[1]) };
            if reaches[0] && self.passes_goal(x, end, y) {
                return self.reach_goal(root);
            }
            x = end;
            let ahead = if is_right { x } else { x - 1 };
            if free != [true; 2] && sides.iter().all(|row| self.rows.has(ahead, *row)) {
                let is_up = !free[0];
                let view = View { root, row: sides[usize::from(!is_up)] as u32, is_up, length: 0.0 };
                let turn = Turn { view, rays: [None; 2], cell: ahead as u32, follows: Some(is_right) };
                self.turn_at(root, (x, y), is_up == is_right, turn);
                // There the corner follows the line, unless all distances from it are known.
                if self.distances.is_none() {
                    return;
                }
            }
        }
    }

    /// Whether the goal is on the lower side of its cell, between two lattice points of a line.
    fn passes_goal(&self, from: usize, to: usize, y: usize) -> bool {
        let (cell, row) = self.goal.cell;
        row == y && self.goal.spot.y == self.plane.lattice(0, y).y && (from.min(to)..from.max(to)).contains(&cell)
    }

    /// Expands a start inside its cell or on its border.
    pub(super) fn begin(&mut self, (cell, row): (usize, usize)) {
        let spot = self.roots[0].spot;
        let view = |row: usize, is_up: bool| View { root: 0, row: row as u32, is_up, length: 0.0 };
        self.look(&view(row, true), [None; 2], cell);
        if spot.y > self.plane.lattice(0, row).y {
            return self.look(&view(row, false), [None; 2], cell);
        }
        let is_left = spot.x == self.plane.lattice(cell, 0).x;
        let below = [cell, cell - 1].map(|x| self.rows.has(x, row) && self.rows.has(x, row - 1));
        if below[0] {
            self.look(&view(row - 1, false), [None; 2], cell);
        } else if is_left && below[1] {
            self.look(&view(row - 1, false), [None; 2], cell - 1);
        }
        let reaches = [true, self.rows.has(cell, row - 1)];
        self.walk(0, (cell, row), true, reaches);
        self.walk(0, (if is_left { cell } else { cell + 1 }, row), false, reaches);
    }
}
