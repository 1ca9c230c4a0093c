"""Decides, once, which effects a material calls for, with which method, and why."""
