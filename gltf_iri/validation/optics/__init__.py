"""What remarks mean in ΔE. Imports numpy; the rules import these modules where they measure."""
