        position = np.sqrt(d / (1.0 + np.sqrt(x))) * last
