//! What the book shows: tables, figures, the ledger of claims, predictions.

mod choosing;
mod figures;
mod ledger;
mod predictions;
mod provenance;
mod readme;
mod rounding;
mod snapshots;
mod stencil;
mod transcription;
mod typed;
