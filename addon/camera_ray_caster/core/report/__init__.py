"""Information about a cast: verification, accuracy, step-by-step explanations, the report, diagrams."""
