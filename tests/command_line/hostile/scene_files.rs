//! Scene folders: manifests, models, textures.
