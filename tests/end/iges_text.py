"""IGES files for tests."""


def iges(entities):
    """An IGES file in millimetres of rows type, form, parameters; D1, D3, ... in their order."""
    def line(text, letter, number):
        return f"{text:<72}{letter}{number:>7}\n"
    directory, data, count = "", "", 0
    for i, (kind, form, parameters) in enumerate(entities):
        pieces = [parameters[k:k + 64] for k in range(0, len(parameters), 64)]
        for j, row in enumerate(((kind, count + 1, 0, 0, 0, 0, 0, 0, "00000000"),
                                 (kind, 0, 0, len(pieces), form, "", "", "", 0))):
            directory += line("".join(f"{x:>8}" for x in row), "D", 2 * i + j + 1)
        for k, piece in enumerate(pieces):
            data += line(f"{piece:<64}{2 * i + 1:>8}", "P", count + k + 1)
        count += len(pieces)
    return (line("", "S", 1) + line("1H,,1H;,,,,,,,,,,,1.,2,2HMM;", "G", 1) + directory + data
            + line(f"S{1:>7}G{1:>7}D{2 * len(entities):>7}P{count:>7}", "T", 1))
