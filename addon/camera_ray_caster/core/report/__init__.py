"""What is said of a cast: verification, accuracy, facts, the report, diagrams."""
