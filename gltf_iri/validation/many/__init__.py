"""Many files: sharing them among workers, keeping the results."""
