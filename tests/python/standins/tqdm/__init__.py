"""Stands in for tqdm."""
