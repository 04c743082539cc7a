"""Cross-checks of the laboratory: closed forms, experiments, and models that share none of its kernels."""
