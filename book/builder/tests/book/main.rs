//! The built book, its chapters, and what a review says.

mod built_book;
mod chapters;
mod claims;
mod folder;
mod hostile;
mod pages;
mod review;
