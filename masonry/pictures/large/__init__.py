"""Pictures of large displacement: what is seen of blocks that have turned and fallen is found anew in every frame."""
