"""What KHR_animation_pointer asks of pointers and of the values that they receive."""
