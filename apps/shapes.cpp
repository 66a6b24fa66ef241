// Analytic samples.
