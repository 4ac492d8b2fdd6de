        # 1 - q, where sqrt(x) = 1 - (7/4) q^2 + (3/4) q^4.
        root = np.sqrt(x)
        grown = np.sqrt(1.0 + 48.0 * root)
        q = np.sqrt(8.0 * d / ((1.0 + root) * (7.0 + grown)))
        position = 8.0 * root / ((1.0 + grown) * (1.0 + q)) * last
