"""Every published method under one name and one signature."""
