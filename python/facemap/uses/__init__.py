"""Ready uses of visibility: each a short function on top of View, visibility and visibility_along."""
