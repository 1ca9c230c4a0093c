"""How reports are told: one module a format, each a function `written` from judged files to pieces of text.

They work from reports as JSON, since results may come from other processes and machines.
"""
