"""The rules: one generator a rule, one file a kind of object; `every` gathers them."""
