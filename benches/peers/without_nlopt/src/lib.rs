//! Replacement of the crate `nlopt` in this package, which avoids a C++ compiler and the LGPL. It has the names that ik-geo calls, and every optimisation
//! fails. So the families that ik-geo solves by search have no solutions here.

/// The failure of every optimisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WithoutNlopt;

/// The requested algorithms.
#[derive(Clone, Copy, Debug)]
pub enum Algorithm {
    GnMlslLds,
    Neldermead,
}

/// The requested direction.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    Minimize,
}

/// An optimiser of the objective `F` with the user's data `T`.
pub struct Nlopt<F, T> {
    _objective: F,
    _data: T,
}

type Answer<T = ()> = Result<T, WithoutNlopt>;

impl<F: Fn(&[f64], Option<&mut [f64]>, &mut T) -> f64, T> Nlopt<F, T> {
    pub fn new(_: Algorithm, _: usize, objective: F, _: Target, data: T) -> Self {
        Nlopt { _objective: objective, _data: data }
    }

    pub fn set_upper_bounds(&mut self, _: &[f64]) -> Answer {
        Ok(())
    }

    pub fn set_lower_bounds(&mut self, _: &[f64]) -> Answer {
        Ok(())
    }

    pub fn set_xtol_abs(&mut self, _: &[f64]) -> Answer {
        Ok(())
    }

    pub fn set_stopval(&mut self, _: f64) -> Answer {
        Ok(())
    }

    pub fn set_maxeval(&mut self, _: u32) -> Answer {
        Ok(())
    }

    pub fn set_population(&mut self, _: usize) -> Answer {
        Ok(())
    }

    pub fn set_local_optimizer(&mut self, _: Self) -> Answer {
        Ok(())
    }

    pub fn optimize(&self, _: &mut [f64]) -> Answer<(WithoutNlopt, f64)> {
        Err(WithoutNlopt)
    }
}
