//! How wrong a table is: its lookup against the closed form, off the nodes.
