"""The balloon itself: sizes, rubber and what theory says about inflated tubes."""
