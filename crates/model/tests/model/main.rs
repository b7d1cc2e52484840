//! Properties of the values of a model: its elements and lengths, the facts about methods, failures, histories, springs.

#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use

mod elements;
mod facts;
mod failures;
mod histories;
mod interactions;
mod lengths;
